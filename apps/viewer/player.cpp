#include "player.h"

#include <fmt/format.h>

#include <utility>

#include "lychnite/base/error.h"

namespace lychnite::viewer {
namespace {

using Kind = ScriptStep::Kind;
using EventKind = InputEvent::Kind;

/// Code points of UTF-8 text.
std::vector<unsigned> codePoints(const std::string& text) {
  std::vector<unsigned> points;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0) == 0x80 && !points.empty())
      points.back() = (points.back() << 6) | (byte & 0x3fu);
    else
      points.push_back(byte < 0x80 ? byte : byte & (byte < 0xe0 ? 0x1fu : byte < 0xf0 ? 0x0fu : 0x07u));
  }
  return points;
}

}  // namespace

Player::Player(std::vector<ScriptStep> steps, std::string where, PlayerHost host)
    : steps_(steps.begin(), steps.end()), where_(std::move(where)), host_(std::move(host)) {}

glm::dvec2 Player::find(const ScriptPlace& place, const Ui& ui, int line) const {
  if (place.control.empty()) return place.at * ui.scale();
  const auto found = ui.marks().find(place.control);
  if (found != ui.marks().end()) return found->second.low + place.at * found->second.size();
  std::string names;
  for (const auto& [name, area] : ui.marks()) names += (names.empty() ? "" : ", ") + name;
  throw Error({.where = fmt::format("{}:{}", where_, line),
               .expected = "a control that the window shows now (" + names + ")",
               .found = fmt::format("'{}'", place.control),
               .todo = ""},
              Error::Kind::kUsage);
}

void Player::pointAt(const glm::dvec2& place) {
  InputEvent move{.kind = EventKind::kMove};
  move.at = place;
  frames_.push_back({move});
}

void Player::button(int which, bool down) {
  InputEvent change{.kind = EventKind::kButton};
  change.button = which;
  change.down = down;
  frames_.push_back({change});
}

void Player::key(const KeyChord& chord) {
  const InputEvent press{
      .kind = EventKind::kKey, .down = true, .key = keyNumber(chord.key), .modifiers = chord};
  InputEvent release = press;
  release.down = false;
  release.modifiers = {};
  frames_.push_back({press});
  frames_.push_back({release});
  frames_.push_back({});
}

void Player::type(const std::string& text) {
  Events events;
  for (const unsigned point : codePoints(text)) {
    InputEvent letter{.kind = EventKind::kText};
    letter.codePoint = point;
    events.push_back(letter);
  }
  frames_.push_back(events);
  frames_.push_back({});
}

void Player::begin(const ScriptStep& step, Window& window, const Ui& ui) {
  switch (step.kind) {
    case Kind::kWaitFrames:
      frames_.assign(size_t(step.count), {});
      break;
    case Kind::kMove:
      pointAt(find(step.to, ui, step.line));
      break;
    case Kind::kPress:
    case Kind::kRelease:
      button(step.button, step.kind == Kind::kPress);
      break;
    case Kind::kClick:
      pointAt(find(step.to, ui, step.line));
      button(step.button, true);
      button(step.button, false);
      frames_.push_back({});  // the window answers before the next step looks for its controls
      break;
    case Kind::kDrag: {
      const glm::dvec2 from = find(step.from, ui, step.line), to = find(step.to, ui, step.line);
      pointAt(from);
      button(step.button, true);
      for (int i = 1; i <= step.count; ++i) pointAt(from + (to - from) * (double(i) / step.count));
      button(step.button, false);
      frames_.push_back({});
      break;
    }
    case Kind::kScroll: {
      InputEvent turn{.kind = EventKind::kScroll};
      turn.notches = step.number;
      frames_.push_back({turn});
      break;
    }
    case Kind::kKey:
      key(step.chord);
      break;
    case Kind::kType:
      type(step.text);
      break;
    case Kind::kDrop: {
      InputEvent drop{.kind = EventKind::kDrop};
      drop.files = step.texts;
      frames_.push_back({drop});
      break;
    }
    case Kind::kResize:
      window.resize(glm::ivec2(step.to.at));
      frames_.assign(3, {});
      break;
    case Kind::kMinimise:
      window.minimise();
      frames_.assign(3, {});
      break;
    case Kind::kRestore:
      window.restore();
      frames_.assign(3, {});
      break;
    case Kind::kScreenshot:
      host_.screenshot(step.text);
      frames_.push_back({});
      break;
    case Kind::kQuit:
      host_.quit();
      break;
    case Kind::kWaitRest:
    case Kind::kWaitNoise:
      break;
  }
}

bool Player::waiting(double seconds) {
  const ScriptStep& step = steps_.front();
  const bool rest = step.kind == Kind::kWaitRest;
  if (!rest && step.kind != Kind::kWaitNoise) return false;
  if (rest ? host_.atRest() : host_.noise() <= step.number) {
    waitBegan_.reset();
    return false;
  }
  if (!waitBegan_) waitBegan_ = seconds;
  if (seconds - *waitBegan_ < kPatience) return true;
  throw Error({.where = fmt::format("{}:{}", where_, step.line),
               .expected = rest ? "the picture to come to rest" : fmt::format("a noise of {}", step.number),
               .found = fmt::format("none within {} s", kPatience),
               .todo = ""});
}

bool Player::waits() const {
  if (!frames_.empty() || steps_.empty()) return false;
  return steps_.front().kind == Kind::kWaitRest || steps_.front().kind == Kind::kWaitNoise;
}

Player::Events Player::next(Window& window, const Ui& ui, double seconds) {
  while (frames_.empty()) {
    if (steps_.empty() || waiting(seconds)) return {};
    const ScriptStep step = std::move(steps_.front());
    steps_.pop_front();
    begin(step, window, ui);
    if (step.kind == Kind::kQuit) return {};
  }
  Events events = std::move(frames_.front());
  frames_.pop_front();
  return events;
}

}  // namespace lychnite::viewer
