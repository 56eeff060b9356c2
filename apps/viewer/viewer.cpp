#include "viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>

#include "hands.h"
#include "lychnite/app/profile_store.h"
#include "lychnite/app/scene_moves.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text_file.h"
#include "lychnite/gpu/context.h"
#include "lychnite/image/io.h"
#include "player.h"
#include "profile_queue.h"

namespace lychnite::viewer {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kMessageSeconds = 6, kProblemSeconds = 20;
constexpr double kBarHeight = 64;          // at scale 1
constexpr int kFramesAfterInput = 3;       // a control may need some to settle
constexpr double kPlayedFrame = 1 / 60.0;  // seconds that a frame of a script stands for
constexpr double kSlowSeconds = 0.1;
constexpr double kFollowSeconds = 1 / 30.0;  // between frames while the processor is the picture's
constexpr size_t kKeptFrames = 120;
constexpr size_t kMostTimed = 100000;  // frames in motion, for the log

/// How long the way to the first picture takes, step by step, on the clock and on the processor.
class Stopwatch {
 public:
  void tell(const LogSink& log, LogLevel level, const std::string& what) const {
    const std::chrono::duration<double> passed = Clock::now() - began_;
    const double worked = double(std::clock() - worked_) / CLOCKS_PER_SEC;
    logTo(log, level,
          fmt::format("{} {:.2f} s after the window, {:.2f} s of work", what, passed.count(), worked));
  }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

 private:
  Clock::time_point began_ = Clock::now();
  std::clock_t worked_ = std::clock();
};

/// What the window shows, as a picture that writePng gives back as it is.
Image windowImage(const gpu::Framebuffer& window) {
  const std::vector<uint8_t> bytes = window.readBytes();
  Image image(window.width(), window.height());
  for (int y = 0; y < window.height(); ++y) {
    for (int x = 0; x < window.width(); ++x) {
      const uint8_t* from =
          &bytes[(size_t(window.height() - 1 - y) * size_t(window.width()) + size_t(x)) * 4];
      glm::vec3 rgb;
      for (int c = 0; c < 3; ++c) rgb[c] = linearFromSrgb(float(from[c]) / 255);
      image.setRgb(size_t(y) * size_t(window.width()) + size_t(x), rgb);
    }
  }
  return image;
}

struct Layout {
  Area picture, bar, panel;
};

Layout layoutOf(glm::ivec2 pixels, double scale, double panelWidth) {
  const double width = std::min(panelWidth * scale, 0.5 * pixels.x),
               bar = std::min(kBarHeight * scale, 0.3 * pixels.y);
  const double x = std::floor(pixels.x - width), y = std::floor(pixels.y - bar);
  return {.picture = {{0, 0}, {x, y}},
          .bar = {{0, y}, {x, double(pixels.y)}},
          .panel = {{x, 0}, glm::dvec2(pixels)}};
}

class Viewer {
 public:
  explicit Viewer(const ViewOptions& options);
  ~Viewer();
  void run();
  /// Saves the scene under a new name of the settings' folder; returns it, "" when that failed too.
  std::string rescue();

 private:
  struct Shown {
    SessionMessage message;
    double until = 0;
  };

  void warmUp();
  void start();
  void makePlayer();
  bool moving() const;
  bool quick() const;
  bool slow() const;
  void frame(const std::vector<InputEvent>& events);
  void handle(const std::vector<InputEvent>& events, PanelContext& context, const Area& picture);
  void drop(const InputEvent& event);
  void animate();
  void takeMessages();
  void draw(PanelContext& context, const Layout& layout);
  void finish(Clock::time_point start);
  void tellFrames() const;
  void screenshot(const fs::path& path);
  bool atRest() const;
  double noise() const;
  Preferences loadPreferences();

  ViewOptions options_;
  Session session_;
  fs::path preferencesPath_;
  Preferences preferences_;
  Window window_;
  Stopwatch stopwatch_;
  gpu::Context context_;
  ProfileQueue profiles_;
  Ui ui_;
  PictureView view_;
  Swatches swatches_;
  Controls controls_;
  Hands hands_;
  std::unique_ptr<Player> player_;
  std::vector<Shown> shown_;
  std::vector<float> movingMs_;
  std::string title_;
  double seconds_ = 0, frameSeconds_ = 1 / 60.0, lastFrame_ = 0;
  int framesLeft_ = kFramesAfterInput;
  bool quit_ = false, swatchesLeft_ = true, pictureShown_ = false;
  // Of the frame that is on the window, its labels included.
  bool rested_ = false;
  double shownNoise_ = std::numeric_limits<double>::infinity();
};

WindowOptions windowOptions(const ViewOptions& options, const Preferences& preferences) {
  return {.width = options.width > 0 ? options.width : preferences.windowWidth,
          .height = options.height > 0 ? options.height : preferences.windowHeight,
          .scale = options.scale,
          .debug = options.debug};
}

Viewer::Viewer(const ViewOptions& options)
    : options_(options),
      preferencesPath_(configFolder().empty() ? fs::path() : configFolder() / "viewer.toml"),
      preferences_(loadPreferences()),
      window_(windowOptions(options, preferences_)),
      context_({.debug = options.debug, .current = true}, options.log),
      ui_(window_),
      view_({.useCurrentContext = true, .profiles = profiles_.maker()},
            // A script has no hands that the walk could disturb.
            {.threads = options.threads > 0 ? options.threads : preferences_.walkThreads,
             .yields = options.play.empty()}),
      swatches_({.useCurrentContext = true}) {
  makePlayer();
  stopwatch_.tell(options_.log, LogLevel::kDebug, "shaders");
  if (session_.loading()) warmUp();
  stopwatch_.tell(options_.log, LogLevel::kDebug, "empty window");
  start();
  stopwatch_.tell(options_.log, LogLevel::kDebug, "model");
}

Viewer::~Viewer() {
  const glm::ivec2 size = window_.windowSize();
  const double scale = options_.scale.value_or(1);
  if (!options_.width && !options_.height && window_.visible()) {
    preferences_.windowWidth = std::clamp(int(size.x / scale), 320, 16384);
    preferences_.windowHeight = std::clamp(int(size.y / scale), 240, 16384);
  }
  window_.hide();  // solvers behind it may take a moment to stop
  if (!session_.empty()) preferences_.ruler = session_.state().ruler;
  writePreferences(preferences_, preferencesPath_, options_.log);
}

/// The first model is asked for before there is a window, so that both get ready together.
Preferences Viewer::loadPreferences() {
  session_.open(options_.model);
  return readPreferences(preferencesPath_, session_.log());
}

/// While the model is made: a window without one, and what drivers only do at the first picture.
void Viewer::warmUp() {
  frame({});
  const glm::ivec2 pixels = window_.pixels();
  const Layout layout = layoutOf(pixels, ui_.scale(), preferences_.panelWidth);
  view_.warmUp(gpu::Framebuffer::ofWindow(pixels.x, pixels.y), layout.picture);
}

void Viewer::start() {
  session_.finishLoading();
  const auto messages = session_.takeMessages();
  if (session_.empty())
    throw Error({.where = options_.model,
                 .expected = "",
                 .found = messages.empty() ? "nothing to show" : messages.front().text,
                 .todo = ""});
  for (const SessionMessage& message : messages) session_.say(message.text, message.problem);
  if (options_.size) setSubjectSize(session_.state().scene, *options_.size);
  if (options_.method) session_.state().settings.method = *options_.method;
  session_.state().ruler = preferences_.ruler;
  if (fs::path(options_.model).has_extension()) preferences_.addRecent(fs::absolute(options_.model).string());
}

void Viewer::makePlayer() {
  std::vector<ScriptStep> steps;
  std::string where = "--screenshot";
  if (!options_.play.empty()) {
    where = options_.play.string();
    steps = parseScript(readText(options_.play), where);
  }
  if (!options_.screenshot.empty()) {
    ScriptStep step{.kind = ScriptStep::Kind::kWaitRest};
    steps.push_back(step);
    step.kind = ScriptStep::Kind::kScreenshot;
    step.text = options_.screenshot.string();
    steps.push_back(step);
  }
  if (steps.empty() && options_.play.empty()) return;
  steps.push_back({.kind = ScriptStep::Kind::kQuit});
  PlayerHost host{.atRest = [this] { return atRest() && (rested_ || !window_.visible()); },
                  .noise = [this] { return shownNoise_; },
                  .screenshot = [this](const std::string& path) { screenshot(path); },
                  .quit = [this] { quit_ = true; }};
  player_ = std::make_unique<Player>(std::move(steps), where, std::move(host));
}

bool Viewer::atRest() const {
  return view_.ready() && view_.atRest() && !session_.loading() && !session_.pictures().busy() &&
         !swatchesLeft_ && !controls_.animation.running() && !profiles_.busy();
}

/// Of the walk's picture; infinite before there is one.
double Viewer::noise() const {
  return view_.walk() ? view_.walk()->noise : std::numeric_limits<double>::infinity();
}

/// A hand or an animation is on the picture.
bool Viewer::moving() const {
  return hands_.holding() || ui_.busy() || controls_.animation.running();
}

/// The window changes with every frame.
bool Viewer::quick() const {
  return framesLeft_ > 0 || !view_.settled() || swatchesLeft_ || controls_.animation.running() ||
         (player_ && !player_->waits());
}

/// Something behind the window goes on, which is worth a look now and then.
bool Viewer::slow() const {
  const bool compares = session_.state().compare.mode != CompareView::Mode::kOff;
  return compares || view_.refines() || !view_.atRest() || !shown_.empty() || session_.pictures().busy() ||
         session_.loading() || profiles_.busy();
}

void Viewer::run() {
  while (!quit_ && !window_.closing() && !hands_.quit()) {
    const bool follows = !player_ && view_.follows();
    const double wait = quick() && window_.visible() ? (follows ? kFollowSeconds : 0)
                        : player_                    ? kPlayedFrame
                        : slow()                     ? kSlowSeconds
                                                     : 2 * kSlowSeconds;
    std::vector<InputEvent> events = window_.events(wait);
    const double now = stopwatch_.seconds();
    if (player_) events = player_->next(window_, ui_, now);
    if (quit_) break;
    const double before = seconds_;
    seconds_ = player_ ? seconds_ + kPlayedFrame : now;
    const bool changed = session_.poll(seconds_);
    const bool arrived = profiles_.takeArrived();
    if (arrived) view_.forget();
    const size_t messages = shown_.size();
    takeMessages();
    if (changed || arrived || !events.empty() || shown_.size() != messages) framesLeft_ = kFramesAfterInput;
    if (!quick() && !(slow() && now - lastFrame_ >= kSlowSeconds)) continue;
    --framesLeft_;
    lastFrame_ = now;
    frameSeconds_ = std::min(seconds_ - before, 0.1);
    if (window_.visible()) frame(events);
  }
  takeMessages();  // the last ones reach the log
  tellFrames();
}

void Viewer::tellFrames() const {
  if (movingMs_.empty()) return;
  std::vector<float> sorted = movingMs_;
  std::sort(sorted.begin(), sorted.end());
  const auto below = [&](double share) { return sorted[size_t(share * double(sorted.size() - 1))]; };
  logTo(options_.log, LogLevel::kDebug,
        fmt::format("{} frames in motion: {:.1f} ms in the middle, nine of ten below {:.1f} ms",
                    sorted.size(), below(0.5), below(0.9)));
}

void Viewer::frame(const std::vector<InputEvent>& events) {
  const auto start = Clock::now();
  const Layout layout = layoutOf(window_.pixels(), ui_.scale(), preferences_.panelWidth);
  PanelContext context{ui_,       session_,     controls_, view_,
                       swatches_, preferences_, window_,   glm::ivec2(layout.picture.size())};
  const bool restedBefore = atRest();
  const double noiseBefore = noise();
  handle(events, context, layout.picture);
  animate();
  draw(context, layout);
  if (!moving()) session_.commit();
  finish(start);
  // Panel and labels are laid out before the picture is drawn: what is new in this frame they tell in the
  // next.
  rested_ = restedBefore && atRest();
  shownNoise_ = std::max(noiseBefore, noise());
  if (rested_ != atRest() || noiseBefore != noise()) framesLeft_ = std::max(framesLeft_, 1);
}

void Viewer::handle(const std::vector<InputEvent>& events, PanelContext& context, const Area& picture) {
  for (const InputEvent& event : events) {
    ui_.feed(event);
    if (event.kind == InputEvent::Kind::kDrop) drop(event);
    if (!ui_.wantsKeys()) hands_.key(event, context);
    hands_.mouse(event, context, picture, !ui_.wantsMouse());
  }
  controls_.turnsLight = hands_.turnsLight();
}

void Viewer::drop(const InputEvent& event) {
  for (const std::string& file : event.files) {
    session_.open(file);
    preferences_.addRecent(fs::absolute(file).string());
  }
}

void Viewer::animate() {
  Animation& animation = controls_.animation;
  if (!animation.running() || session_.empty()) return;
  const double degrees = animation.degreesPerSecond * frameSeconds_;
  if (animation.lights) turnLights(session_.state().scene, degrees);
  if (animation.objects) turnObjects(session_.state().scene, degrees);
  Scene& scene = session_.state().scene;
  animation.clips = animation.clips && scene.objects[subjectIndex(scene)].animation;
  if (animation.clips) pose(controls_, session_, [&] { playClips(scene, frameSeconds_); });
}

void Viewer::takeMessages() {
  for (SessionMessage& message : session_.takeMessages()) {
    logTo(options_.log, message.problem ? LogLevel::kWarning : LogLevel::kInfo, message.text);
    shown_.push_back({message, seconds_ + (message.problem ? kProblemSeconds : kMessageSeconds)});
  }
  std::erase_if(shown_, [&](const Shown& shown) { return shown.until < seconds_; });
}

void Viewer::draw(PanelContext& context, const Layout& layout) {
  // Before the panel: what it shows must stay as it is until the window is drawn.
  swatchesLeft_ = !view_.settled() || swatches_.drawOne(view_.display());
  ui_.begin(frameSeconds_);
  controls_.inspects = false;
  drawPanel(context, layout.panel);
  drawSizeBar(context, layout.bar);
  std::vector<SessionMessage> messages;
  for (const Shown& shown : shown_) messages.push_back(shown.message);
  drawOverlay(context, layout.picture, messages);
  const glm::ivec2 pixels = window_.pixels(), area(layout.picture.size());
  gpu::Framebuffer target = gpu::Framebuffer::ofWindow(pixels.x, pixels.y);
  if (!session_.empty() && area.x > 0 && area.y > 0)
    view_.update({.state = &session_.state(),
                  .pixels = area,
                  .moving = moving(),
                  .seconds = seconds_,
                  .file = session_.picture(),
                  .judge = controls_.inspects});
  for (const std::string& problem : view_.takeProblems()) session_.say(problem, true);
  target.clearColour(0, {0.05f, 0.05f, 0.052f, 1});
  view_.show(target, {{0, 0}, glm::dvec2(area)}, session_.state());
  ui_.end();
}

void Viewer::finish(Clock::time_point start) {
  window_.swap();
  context_.checkErrors("view");
  const double milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  view_.frameTook(milliseconds);
  if (!pictureShown_ && view_.ready()) {
    pictureShown_ = true;
    stopwatch_.tell(options_.log, LogLevel::kInfo, "first picture");
  }
  if (view_.drew()) controls_.frameMs.push_back(float(milliseconds));
  if (view_.drew() && moving() && movingMs_.size() < kMostTimed) movingMs_.push_back(float(milliseconds));
  if (controls_.frameMs.size() > kKeptFrames) controls_.frameMs.erase(controls_.frameMs.begin());
  const std::string title = session_.documentName() + " - Lychnite";
  if (title != title_) window_.setTitle(title_ = title);
}

std::string Viewer::rescue() {
  if (session_.empty() || preferencesPath_.empty()) return "";
  const fs::path path = preferencesPath_.parent_path() / fmt::format("rescued-{}.toml", std::time(nullptr));
  std::error_code code;
  fs::create_directories(path.parent_path(), code);
  return session_.saveSceneAs(path).string();
}

void Viewer::screenshot(const fs::path& path) {
  const glm::ivec2 pixels = window_.pixels();
  writePng(windowImage(gpu::Framebuffer::ofWindow(pixels.x, pixels.y)), path);
}

}  // namespace

void runViewer(const ViewOptions& options) {
  Viewer viewer(options);
  try {
    viewer.run();
  } catch (const Error& error) {
    // A device that was reset takes the window with it, but not the work.
    if (error.kind() != Error::Kind::kDevice) throw;
    const std::string kept = viewer.rescue();
    if (kept.empty()) throw;
    Error::Parts parts = error.parts();
    parts.todo = "the scene was kept as " + kept + (parts.todo.empty() ? "" : "; " + parts.todo);
    throw Error(parts, error.kind());
  }
}

}  // namespace lychnite::viewer
