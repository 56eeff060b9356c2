#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lychnite::paper {

using Json = nlohmann::ordered_json;

/// A text, a number, or nothing (an empty text).
struct Cell {
  Cell(std::string words) : text(std::move(words)) {}  // NOLINT
  Cell(const char* words) : text(words) {}             // NOLINT
  Cell(double value) : number(value) {}                // NOLINT
  std::string text;
  std::optional<double> number;
  bool operator==(const Cell&) const = default;
};

struct Column {
  std::string name;   ///< as shown
  std::string key;    ///< in JSON and CSV, with the unit: "time_ms"
  int digits = 2;     ///< after the point, as shown; files hold all
  double factor = 1;  ///< from the files' unit to the shown one (100 for a share shown in %)
};

struct Table {
  std::string name;  ///< of its CSV
  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
};

/// A picture of a row. `exr` may be empty.
struct Picture {
  std::string file, exr;  ///< names in the part's folder
  std::string label;      ///< under it
  std::string detail;     ///< second line, smaller
};

/// Pictures in a grid of `columns` with one caption.
struct Gallery {
  std::string title{};  ///< above it; may be empty
  std::vector<Picture> pictures;
  int columns = 3;
  int cellWidth = 0;  ///< at most, in pixels of the page; 0: what there is room for
  std::string caption;
};

struct Paragraph {
  std::string text;
};

using Block = std::variant<Paragraph, Gallery, Table>;

/// What a part has made: the body of its section.
struct Report {
  std::string part, title;
  std::string stamp;    ///< of what made it
  double seconds = 0;   ///< that making it took, pictures found on disk not counted
  std::string differs;  ///< what is not as in the paper
  std::vector<Block> blocks;
  std::vector<std::string> files;  ///< in the part's folder
};

/// Everything, numbers unrounded. Not-a-numbers become null.
Json toJson(const Report& report);
/// Throws nlohmann's exceptions for what is not a report.
Report reportFrom(const Json& json);

/// RFC 4180, the keys as first line.
std::string csvOf(const Table& table);

/// A cell as shown on the page.
std::string shown(const Cell& cell, const Column& column);

}  // namespace lychnite::paper
