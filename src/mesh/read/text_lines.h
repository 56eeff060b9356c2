#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lychnite {

/// The words of one line, in order, with errors that name "path:line".
class Words {
 public:
  /// `cut`: the text ended before the line did, so that missing words mean a truncated file.
  Words(std::string_view line, const std::string& where, size_t number, bool cut = false)
      : rest_(line), where_(&where), number_(number), cut_(cut) {}

  /// The next word, or "" at the line's end.
  std::string_view next();
  /// The next word as a number; past the range of doubles it is infinity (which repairMesh refuses) or 0.
  double number();
  int64_t integer();
  /// The same, refusing negative ones.
  uint64_t count();

  std::string_view rest() const { return rest_; }
  size_t lineNumber() const { return number_; }
  std::string where() const { return *where_ + ":" + std::to_string(number_); }
  [[noreturn]] void fail(const std::string& expected, std::string_view found) const;

 private:
  std::string_view rest_;
  const std::string* where_;
  size_t number_;
  bool cut_;
};

/// Walks over the lines of a text; "\n", "\r\n" and "\r" end one.
class TextLines {
 public:
  /// `where` must outlive this.
  TextLines(std::string_view text, const std::string& where) : text_(text), where_(&where) {}

  bool atEnd() const { return at_ >= text_.size(); }
  size_t bytesLeft() const { return text_.size() - at_; }
  size_t offset() const { return at_; }
  /// The next line, as it is.
  Words line();
  /// The next line that has a word before the first `comment` character. Throws Error ("truncated") at the
  /// end of the text, saying that `what` was expected.
  Words fullLine(char comment, const char* what);

 private:
  bool lastLineCut() const { return at_ == text_.size() && !text_.ends_with('\n') && !text_.ends_with('\r'); }

  std::string_view text_;
  const std::string* where_;
  size_t at_ = 0, number_ = 0;
};

}  // namespace lychnite
