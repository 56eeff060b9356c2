#include "lychnite/app/input_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/base/units.h"

namespace lychnite {
namespace {

using Kind = ScriptStep::Kind;

[[noreturn]] void refuse(std::string_view where, std::string expected, std::string_view found) {
  throw Error({.where = std::string(where),
               .expected = std::move(expected),
               .found = fmt::format("'{}'", found),
               .todo = ""},
              Error::Kind::kUsage);
}

/// Words, or parts in double quotes; a # that begins a word begins a comment.
std::vector<std::string> wordsOf(std::string_view line, std::string_view where) {
  std::vector<std::string> words;
  size_t i = 0;
  while (true) {
    while (i < line.size() && std::isspace(static_cast<unsigned char>(line[i]))) ++i;
    if (i >= line.size() || line[i] == '#') return words;
    std::string word;
    if (line[i] == '"') {
      const size_t end = line.find('"', i + 1);
      if (end == std::string_view::npos) refuse(where, "a closing quote", line.substr(i));
      word = line.substr(i + 1, end - i - 1);
      i = end + 1;
    } else {
      while (i < line.size() && !std::isspace(static_cast<unsigned char>(line[i]))) word += line[i++];
    }
    words.push_back(word);
  }
}

glm::dvec2 pairOf(std::string_view text, std::string_view where) {
  const auto parts = split(text, ',');
  if (parts.size() != 2) refuse(where, "X,Y", text);
  return {parseNumber(parts[0], where), parseNumber(parts[1], where)};
}

ScriptPlace placeOf(const std::string& text, std::string_view where) {
  if (!text.starts_with('@')) return {.control = "", .at = pairOf(text, where)};
  const auto colon = text.find(':');
  ScriptPlace place{.control = text.substr(1, colon == std::string::npos ? colon : colon - 1)};
  if (place.control.empty()) refuse(where, "X,Y or @control or @control:FX,FY", text);
  if (colon != std::string::npos) place.at = pairOf(text.substr(colon + 1), where);
  return place;
}

int buttonOf(const std::string& text, std::string_view where) {
  if (text == "left") return 0;
  if (text == "right") return 1;
  if (text == "middle") return 2;
  refuse(where, "left, right or middle", text);
}

int wholeNumber(const std::string& text, std::string_view where, int least, int most) {
  const double value = parseNumber(text, where);
  if (value != double(int(value)) || value < least || value > most)
    refuse(where, fmt::format("a whole number from {} to {}", least, most), text);
  return int(value);
}

void readWait(ScriptStep& step, const std::string& what, std::string_view where) {
  if (what == "rest") {
    step.kind = Kind::kWaitRest;
  } else if (what.ends_with('%')) {
    step.kind = Kind::kWaitNoise;
    step.number = parseNumber(what.substr(0, what.size() - 1), where) / 100;
  } else {
    step.kind = Kind::kWaitFrames;
    step.count = wholeNumber(what, where, 1, 1'000'000);
  }
}

/// The verbs: how many words may follow, and how they are read.
struct Verb {
  const char* name;
  size_t least, most;
  const char* usage;
  void (*read)(ScriptStep&, const std::vector<std::string>& words, std::string_view where);
};

using Words = std::vector<std::string>;
constexpr Verb kVerbs[] = {
    {"wait", 1, 1, "wait FRAMES | rest | NOISE%",
     [](ScriptStep& s, const Words& w, std::string_view at) { readWait(s, w[1], at); }},
    {"move", 1, 1, "move PLACE",
     [](ScriptStep& s, const Words& w, std::string_view at) {
       s.kind = Kind::kMove;
       s.to = placeOf(w[1], at);
     }},
    {"press", 0, 1, "press [left|right|middle]",
     [](ScriptStep& s, const Words& w, std::string_view at) {
       s.kind = Kind::kPress;
       s.button = w.size() > 1 ? buttonOf(w[1], at) : 0;
     }},
    {"release", 0, 1, "release [left|right|middle]",
     [](ScriptStep& s, const Words& w, std::string_view at) {
       s.kind = Kind::kRelease;
       s.button = w.size() > 1 ? buttonOf(w[1], at) : 0;
     }},
    {"click", 1, 2, "click PLACE [left|right|middle]",
     [](ScriptStep& s, const Words& w, std::string_view at) {
       s.kind = Kind::kClick;
       s.to = placeOf(w[1], at);
       s.button = w.size() > 2 ? buttonOf(w[2], at) : 0;
     }},
    {"drag", 2, 4, "drag PLACE PLACE [left|right|middle] [FRAMES]",
     [](ScriptStep& s, const Words& w, std::string_view at) {
       s.kind = Kind::kDrag;
       s.from = placeOf(w[1], at);
       s.to = placeOf(w[2], at);
       s.button = w.size() > 3 ? buttonOf(w[3], at) : 0;
       s.count = w.size() > 4 ? wholeNumber(w[4], at, 1, 10000) : 8;
     }},
    {"scroll", 1, 1, "scroll NOTCHES",
     [](ScriptStep& s, const Words& w, std::string_view at) {
       s.kind = Kind::kScroll;
       s.number = parseNumber(w[1], at);
     }},
    {"key", 1, 1, "key [ctrl+][shift+][alt+]KEY",
     [](ScriptStep& s, const Words& w, std::string_view at) {
       s.kind = Kind::kKey;
       s.chord = parseChord(w[1], at);
     }},
    {"type", 1, 1, "type TEXT",
     [](ScriptStep& s, const Words& w, std::string_view) {
       s.kind = Kind::kType;
       s.text = w[1];
     }},
    {"drop", 1, 64, "drop FILE...",
     [](ScriptStep& s, const Words& w, std::string_view) {
       s.kind = Kind::kDrop;
       s.texts.assign(w.begin() + 1, w.end());
     }},
    {"resize", 2, 2, "resize WIDTH HEIGHT",
     [](ScriptStep& s, const Words& w, std::string_view at) {
       s.kind = Kind::kResize;
       s.to.at = {wholeNumber(w[1], at, 1, 16384), wholeNumber(w[2], at, 1, 16384)};
     }},
    {"minimise", 0, 0, "minimise",
     [](ScriptStep& s, const Words&, std::string_view) { s.kind = Kind::kMinimise; }},
    {"restore", 0, 0, "restore",
     [](ScriptStep& s, const Words&, std::string_view) { s.kind = Kind::kRestore; }},
    {"screenshot", 1, 1, "screenshot FILE.png",
     [](ScriptStep& s, const Words& w, std::string_view) {
       s.kind = Kind::kScreenshot;
       s.text = w[1];
     }},
    {"quit", 0, 0, "quit", [](ScriptStep& s, const Words&, std::string_view) { s.kind = Kind::kQuit; }},
};

const Verb& verbOf(const std::string& name, std::string_view where) {
  std::vector<std::string> names;
  for (const Verb& verb : kVerbs) {
    if (name == verb.name) return verb;
    names.emplace_back(verb.name);
  }
  const std::string nearest = nearestName(name, names);
  throw Error({.where = std::string(where),
               .expected = "an input event (wait, move, click, drag, key, ...)",
               .found = fmt::format("'{}'", name),
               .todo = nearest.empty() ? "" : fmt::format("did you mean '{}'?", nearest)},
              Error::Kind::kUsage);
}

}  // namespace

const std::vector<std::string>& namedKeys() {
  static const std::vector<std::string> names{"escape", "enter", "tab",  "backspace", "delete", "space",
                                              "left",   "right", "up",   "down",      "home",   "end",
                                              "[",      "]",     "plus", "minus",     "f1"};
  return names;
}

KeyChord parseChord(std::string_view text, std::string_view where) {
  KeyChord chord;
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  auto parts = split(lower, '+');
  chord.key = parts.back();
  parts.pop_back();
  for (const std::string& part : parts) {
    if (part == "ctrl")
      chord.ctrl = true;
    else if (part == "shift")
      chord.shift = true;
    else if (part == "alt")
      chord.alt = true;
    else
      refuse(where, "ctrl, shift or alt before the key", text);
  }
  const bool simple = chord.key.size() == 1 && std::isalnum(static_cast<unsigned char>(chord.key[0]));
  if (!simple && std::find(namedKeys().begin(), namedKeys().end(), chord.key) == namedKeys().end())
    refuse(where, "a letter, a digit or a named key", text);
  return chord;
}

std::vector<ScriptStep> parseScript(std::string_view text, std::string_view where) {
  std::vector<ScriptStep> steps;
  int number = 0;
  for (const std::string& line : split(text, '\n')) {
    const std::string at = fmt::format("{}:{}", where, ++number);
    const auto words = wordsOf(line, at);
    if (words.empty()) continue;
    const Verb& verb = verbOf(words.front(), at);
    if (words.size() - 1 < verb.least || words.size() - 1 > verb.most) refuse(at, verb.usage, line);
    ScriptStep step;
    step.line = number;
    verb.read(step, words, at);
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace lychnite
