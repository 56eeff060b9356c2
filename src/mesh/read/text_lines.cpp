#include "mesh/read/text_lines.h"

#include <charconv>
#include <limits>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

constexpr std::string_view kBlanks = " \t\v\f\r";

// What a user can read of a word from a file that may be anything.
std::string shown(std::string_view word) {
  constexpr size_t kMost = 24;
  std::string text = "'";
  for (const char c : word.substr(0, kMost)) text += c >= 32 && c < 127 ? c : '?';
  return text + (word.size() > kMost ? "...'" : "'");
}

}  // namespace

std::string_view Words::next() {
  const size_t begin = std::min(rest_.find_first_not_of(kBlanks), rest_.size());
  const size_t end = std::min(rest_.find_first_of(kBlanks, begin), rest_.size());
  const std::string_view word = rest_.substr(begin, end - begin);
  rest_.remove_prefix(end);
  return word;
}

double Words::number() {
  const std::string_view word = next();
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  double value = 0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || end != digits.data() + digits.size() || code == std::errc::invalid_argument)
    fail("a number", word);
  if (code == std::errc::result_out_of_range) {
    const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
    return tiny ? 0 : std::numeric_limits<double>::infinity();
  }
  return value;
}

int64_t Words::integer() {
  const std::string_view word = next();
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  int64_t value = 0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || end != digits.data() + digits.size() || code != std::errc())
    fail("a whole number", word);
  return value;
}

uint64_t Words::count() {
  const int64_t value = integer();
  if (value < 0) fail("a number of zero or more", std::to_string(value));
  return static_cast<uint64_t>(value);
}

void Words::fail(const std::string& expected, std::string_view found) const {
  throw Error({.where = where(),
               .expected = expected,
               .found = !found.empty() ? shown(found)
                        : cut_         ? "the end of the file: it is truncated"
                                       : "the end of the line",
               .todo = "download or export the model again"});
}

Words TextLines::line() {
  const size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
  const std::string_view text = text_.substr(at_, end - at_);
  at_ = end;
  if (at_ < text_.size()) at_ += text_.substr(at_, 2) == "\r\n" ? 2 : 1;
  return {text, *where_, ++number_, lastLineCut()};
}

Words TextLines::fullLine(char comment, const char* what) {
  while (!atEnd()) {
    const Words found = line();
    const std::string_view text = found.rest().substr(0, found.rest().find(comment));
    if (text.find_first_not_of(kBlanks) != text.npos) return {text, *where_, number_, lastLineCut()};
  }
  throw Error({.where = *where_,
               .expected = what,
               .found = "the end of the file: it is truncated",
               .todo = "download or export it again"});
}

}  // namespace lychnite
