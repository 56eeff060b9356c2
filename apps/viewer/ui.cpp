#include "ui.h"

#include <backends/imgui_impl_opengl3.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "lychnite/image/montage.h"
#include "lychnite/image/tone_map.h"

namespace lychnite::viewer {
namespace {

constexpr float kFontPixels = 14;

void mapKeys(ImGuiIO& io) {
  const std::pair<ImGuiKey, int> keys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                           {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                           {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                           {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                           {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                           {ImGuiKey_Home, GLFW_KEY_HOME},
                                           {ImGuiKey_End, GLFW_KEY_END},
                                           {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                           {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                           {ImGuiKey_Space, GLFW_KEY_SPACE},
                                           {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                           {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                           {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                           {ImGuiKey_A, GLFW_KEY_A},
                                           {ImGuiKey_C, GLFW_KEY_C},
                                           {ImGuiKey_V, GLFW_KEY_V},
                                           {ImGuiKey_X, GLFW_KEY_X},
                                           {ImGuiKey_Y, GLFW_KEY_Y},
                                           {ImGuiKey_Z, GLFW_KEY_Z}};
  for (const auto& [to, from] : keys) io.KeyMap[to] = from;
}

const char* getClipboard(void* user) {
  static std::string text;
  text = static_cast<Window*>(user)->clipboard();
  return text.c_str();
}

void setClipboard(void* user, const char* text) {
  static_cast<Window*>(user)->setClipboard(text);
}

void tooltip(const char* text) {
  if (!text || !*text || !ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

std::string hidden(const char* text) {
  return std::string("##") + text;
}

}  // namespace

std::string markName(const std::string& label) {
  std::string name;
  for (const char c : label.substr(0, label.find(','))) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte == 0xcf) name += "sigma-";  // the first byte of the one Greek letter that names need
    if (byte >= 0x80) continue;
    const bool plain = std::isalnum(byte) != 0;
    if (plain)
      name += char(std::tolower(byte));
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name;
}

Ui::Ui(Window& window) : window_(window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // our own preferences keep what is worth keeping
  io.BackendPlatformName = "lychnite";
  io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.GetClipboardTextFn = getClipboard;
  io.SetClipboardTextFn = setClipboard;
  io.ClipboardUserData = &window_;
  mapKeys(io);
  scale_ = window_.scale();
  setFont();
  setTheme();
  ImGui_ImplOpenGL3_Init("#version 450");
}

Ui::~Ui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void Ui::setFont() {
  static const ImWchar kRanges[] = {0x20,   0x24f,  0x370,  0x3ff,  0x2010, 0x2027, 0x2070,
                                    0x209f, 0x2190, 0x21ff, 0x2264, 0x2265, 0};
  ImGuiIO& io = ImGui::GetIO();
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  const std::string_view font = labelFont();
  io.Fonts->Clear();
  io.Fonts->AddFontFromMemoryTTF(const_cast<char*>(font.data()), int(font.size()),
                                 std::round(kFontPixels * float(scale_)), &config, kRanges);
}

void Ui::setTheme() {
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowRounding = style.ChildRounding = 0;
  style.FrameRounding = style.GrabRounding = style.PopupRounding = 3;
  style.WindowBorderSize = 0;
  style.WindowPadding = {12, 10};
  style.FramePadding = {6, 3};
  style.ItemSpacing = {6, 5};
  style.ScrollbarSize = 10;
  style.GrabMinSize = 5;  // the number lies over it
  const auto grey = [](float v, float a = 1) { return ImVec4(v, v, v * 1.02f, a); };
  const auto amber = [](float a) { return ImVec4(0.85f, 0.62f, 0.33f, a); };
  ImVec4* c = style.Colors;
  c[ImGuiCol_Text] = grey(0.86f);
  c[ImGuiCol_TextDisabled] = grey(0.52f);
  c[ImGuiCol_WindowBg] = grey(0.115f);
  c[ImGuiCol_PopupBg] = grey(0.15f, 0.98f);
  c[ImGuiCol_FrameBg] = grey(0.19f);
  c[ImGuiCol_FrameBgHovered] = grey(0.24f);
  c[ImGuiCol_FrameBgActive] = grey(0.27f);
  c[ImGuiCol_Button] = grey(0.22f);
  c[ImGuiCol_ButtonHovered] = grey(0.29f);
  c[ImGuiCol_ButtonActive] = grey(0.34f);
  c[ImGuiCol_Header] = grey(0.155f);
  c[ImGuiCol_HeaderHovered] = grey(0.21f);
  c[ImGuiCol_HeaderActive] = grey(0.24f);
  c[ImGuiCol_SliderGrab] = amber(0.5f);
  c[ImGuiCol_SliderGrabActive] = amber(1);
  c[ImGuiCol_CheckMark] = amber(1);
  c[ImGuiCol_PlotHistogram] = c[ImGuiCol_PlotHistogramHovered] = amber(0.45f);
  c[ImGuiCol_TextSelectedBg] = amber(0.35f);
  c[ImGuiCol_Separator] = grey(0.2f);
  c[ImGuiCol_ScrollbarBg] = grey(0.115f);
  c[ImGuiCol_ScrollbarGrab] = grey(0.25f);
  style.ScaleAllSizes(float(scale_));
  ImGui::GetStyle() = style;
}

void Ui::feed(const InputEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  switch (event.kind) {
    case InputEvent::Kind::kMove:
      io.MousePos = toIm(event.at);
      break;
    case InputEvent::Kind::kButton: {
      // A press and its release may come within one frame: ImGui must see the press first.
      const size_t b = size_t(event.button);
      if (event.down) pressed_[b] = true;
      held_[b] = event.down;
      break;
    }
    case InputEvent::Kind::kScroll:
      io.MouseWheel += float(event.notches);
      break;
    case InputEvent::Kind::kKey:
      if (event.key >= 0 && event.key < int(IM_ARRAYSIZE(io.KeysDown))) io.KeysDown[event.key] = event.down;
      io.KeyCtrl = event.modifiers.ctrl;
      io.KeyShift = event.modifiers.shift;
      io.KeyAlt = event.modifiers.alt;
      break;
    case InputEvent::Kind::kText:
      io.AddInputCharacter(event.codePoint);
      break;
    case InputEvent::Kind::kFocus:
      if (!event.down) std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
      break;
    case InputEvent::Kind::kDrop:
      break;
  }
}

void Ui::begin(double seconds) {
  ImGuiIO& io = ImGui::GetIO();
  if (window_.scale() != scale_) {
    scale_ = window_.scale();
    setFont();
    setTheme();
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }
  const glm::ivec2 size = window_.pixels();
  io.DisplaySize = ImVec2(float(size.x), float(size.y));
  io.DeltaTime = float(std::max(seconds, 1e-4));
  for (size_t b = 0; b < held_.size(); ++b) io.MouseDown[b] = held_[b] || std::exchange(pressed_[b], false);
  marks_.clear();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
}

void Ui::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  const ImGuiMouseCursor cursor = ImGui::GetMouseCursor();
  window_.setCursor(cursor == ImGuiMouseCursor_TextInput  ? Window::Cursor::kText
                    : cursor == ImGuiMouseCursor_ResizeEW ? Window::Cursor::kHorizontal
                    : cursor == ImGuiMouseCursor_Hand     ? Window::Cursor::kHand
                                                          : Window::Cursor::kArrow);
}

bool Ui::wantsMouse() const {
  return ImGui::GetIO().WantCaptureMouse;
}
bool Ui::wantsKeys() const {
  return ImGui::GetIO().WantTextInput;
}
bool Ui::busy() const {
  return ImGui::IsAnyItemActive();
}

void Ui::mark(const std::string& name) {
  mark(name, {fromIm(ImGui::GetItemRectMin()), fromIm(ImGui::GetItemRectMax())});
}
void Ui::mark(const std::string& name, const Area& area) {
  marks_[name] = area;
}

void Ui::label(const char* text, const char* help) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  tooltip(help);
  ImGui::SameLine(float(118 * scale_));
  ImGui::SetNextItemWidth(-1);
}

void Ui::help(const char* text) {
  tooltip(text);
}

bool Ui::slider(const char* text, const char* help, double& value, double low, double high,
                const char* format, bool logarithmic) {
  label(text, help);
  const ImGuiSliderFlags flags = logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
  const bool changed = ImGui::SliderScalar(hidden(text).c_str(), ImGuiDataType_Double, &value, &low, &high,
                                           format, flags | ImGuiSliderFlags_NoRoundToFormat);
  mark(markName(text));
  if (changed) value = std::clamp(std::isfinite(value) ? value : low, low, high);
  return changed;
}

bool Ui::slider(const char* text, const char* help, int& value, int low, int high) {
  label(text, help);
  const bool changed =
      ImGui::SliderInt(hidden(text).c_str(), &value, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
  mark(markName(text));
  return changed;
}

bool Ui::sliders(const char* text, const char* help, Rgb& value, double low, double high, const char* format,
                 bool logarithmic) {
  label(text, help);
  ImGui::PushID(text);
  const float gap = float(4 * scale_), width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  const ImGuiSliderFlags flags = logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
  static const ImVec4 kTints[3] = {
      {0.75f, 0.35f, 0.33f, 0.55f}, {0.4f, 0.65f, 0.38f, 0.5f}, {0.38f, 0.52f, 0.8f, 0.55f}};
  bool changed = false;
  for (int c = 0; c < 3; ++c) {
    if (c > 0) ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(width);
    ImGui::PushID(c);
    ImGui::PushStyleColor(ImGuiCol_SliderGrab, kTints[c]);
    changed |= ImGui::SliderScalar("##v", ImGuiDataType_Double, &value[c], &low, &high, format,
                                   flags | ImGuiSliderFlags_NoRoundToFormat);
    ImGui::PopStyleColor();
    ImGui::PopID();
    mark(markName(text) + "-" + "rgb"[c]);
  }
  ImGui::PopID();
  if (changed)
    for (int c = 0; c < 3; ++c) value[c] = std::clamp(std::isfinite(value[c]) ? value[c] : low, low, high);
  return changed;
}

bool Ui::colour(const char* text, const char* help, Rgb& value) {
  label(text, help);
  // Shown and picked as it looks, kept linear; what is brighter than white keeps its brightness.
  const double most = std::max({value.x, value.y, value.z, 1.0});
  float shown[3];
  for (int c = 0; c < 3; ++c) shown[c] = srgbFromLinear(float(value[c] / most));
  const bool changed = ImGui::ColorEdit3(hidden(text).c_str(), shown, ImGuiColorEditFlags_Float);
  mark(markName(text));
  if (changed)
    for (int c = 0; c < 3; ++c) value[c] = std::clamp(double(linearFromSrgb(shown[c])), 0.0, 1.0) * most;
  return changed;
}

bool Ui::choice(const char* text, const char* help, int& value, const std::vector<std::string>& names) {
  label(text, help);
  bool changed = false;
  const bool open = ImGui::BeginCombo(hidden(text).c_str(), names[size_t(value)].c_str());
  mark(markName(text));
  if (!open) return false;
  for (int i = 0; i < int(names.size()); ++i) {
    if (ImGui::Selectable(names[size_t(i)].c_str(), i == value)) {
      changed = i != value;
      value = i;
    }
    mark(markName(text) + "-" + markName(names[size_t(i)]));
  }
  ImGui::EndCombo();
  return changed;
}

bool Ui::check(const char* text, const char* help, bool& value) {
  const bool changed = ImGui::Checkbox(text, &value);
  mark(markName(text));
  tooltip(help);
  return changed;
}

bool Ui::button(const char* text, const char* help, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(text);
  ImGui::EndDisabled();
  mark(markName(text));
  tooltip(help);
  return pressed;
}

void Ui::note(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

}  // namespace lychnite::viewer
