#include "app/paper/report.h"

#include <fmt/format.h>

#include <cmath>

namespace lychnite::paper {
namespace {

Json cellJson(const Cell& cell) {
  if (cell.number) return std::isfinite(*cell.number) ? Json(*cell.number) : Json(nullptr);
  return cell.text.empty() ? Json(nullptr) : Json(cell.text);
}

Cell cellFrom(const Json& json) {
  if (json.is_null()) return "";
  if (json.is_string()) return json.get<std::string>();
  return json.get<double>();
}

Json toJson(const Table& table) {
  Json json{
      {"table", table.name}, {"caption", table.caption}, {"columns", Json::array()}, {"rows", Json::array()}};
  for (const Column& c : table.columns)
    json["columns"].push_back({{"key", c.key}, {"name", c.name}, {"digits", c.digits}, {"factor", c.factor}});
  for (const std::vector<Cell>& row : table.rows) {
    Json& out = json["rows"].emplace_back(Json::object());
    for (size_t i = 0; i < row.size(); ++i) out[table.columns[i].key] = cellJson(row[i]);
  }
  return json;
}

Table tableFrom(const Json& json) {
  Table table{.name = json.at("table"), .caption = json.at("caption")};
  for (const Json& c : json.at("columns"))
    table.columns.push_back({c.at("name"), c.at("key"), c.at("digits"), c.at("factor")});
  for (const Json& row : json.at("rows")) {
    std::vector<Cell>& cells = table.rows.emplace_back();
    for (const Column& c : table.columns) cells.push_back(cellFrom(row.at(c.key)));
  }
  return table;
}

Json toJson(const Gallery& gallery) {
  Json json{{"title", gallery.title},
            {"gallery", Json::array()},
            {"columns", gallery.columns},
            {"cell_width", gallery.cellWidth},
            {"caption", gallery.caption}};
  for (const Picture& p : gallery.pictures)
    json["gallery"].push_back({{"file", p.file}, {"exr", p.exr}, {"label", p.label}, {"detail", p.detail}});
  return json;
}

Gallery galleryFrom(const Json& json) {
  Gallery gallery{.title = json.at("title"),
                  .columns = json.at("columns"),
                  .cellWidth = json.at("cell_width"),
                  .caption = json.at("caption")};
  for (const Json& p : json.at("gallery"))
    gallery.pictures.push_back({p.at("file"), p.at("exr"), p.at("label"), p.at("detail")});
  return gallery;
}

Json blockJson(const Block& block) {
  if (const auto* table = std::get_if<Table>(&block)) return toJson(*table);
  if (const auto* gallery = std::get_if<Gallery>(&block)) return toJson(*gallery);
  return {{"text", std::get<Paragraph>(block).text}};
}

Block blockFrom(const Json& json) {
  if (json.contains("table")) return tableFrom(json);
  if (json.contains("gallery")) return galleryFrom(json);
  return Paragraph{json.at("text")};
}

std::string csvCell(const Cell& cell) {
  if (cell.number) return std::isfinite(*cell.number) ? fmt::format("{}", *cell.number) : "";
  const std::string& text = cell.text;
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

Json toJson(const Report& report) {
  Json json{{"part", report.part},       {"title", report.title},     {"stamp", report.stamp},
            {"seconds", report.seconds}, {"differs", report.differs}, {"blocks", Json::array()}};
  json["files"] = report.files;
  for (const Block& block : report.blocks) json["blocks"].push_back(blockJson(block));
  return json;
}

Report reportFrom(const Json& json) {
  Report report{.part = json.at("part"),
                .title = json.at("title"),
                .stamp = json.at("stamp"),
                .seconds = json.at("seconds"),
                .differs = json.at("differs")};
  report.files = json.at("files").get<std::vector<std::string>>();
  for (const Json& block : json.at("blocks")) report.blocks.push_back(blockFrom(block));
  return report;
}

std::string csvOf(const Table& table) {
  std::string text;
  for (size_t i = 0; i < table.columns.size(); ++i)
    text.append(i ? "," : "").append(csvCell(table.columns[i].key));
  text += "\r\n";
  for (const std::vector<Cell>& row : table.rows) {
    for (size_t i = 0; i < row.size(); ++i) text.append(i ? "," : "").append(csvCell(row[i]));
    text += "\r\n";
  }
  return text;
}

std::string shown(const Cell& cell, const Column& column) {
  if (!cell.number) return cell.text;
  const double value = *cell.number * column.factor;
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, column.digits) : "";
}

}  // namespace lychnite::paper
