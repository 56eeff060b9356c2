#include "app/paper/page.h"

#include <fmt/format.h>

#include "lychnite/base/text.h"

namespace lychnite::paper {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: #1c1c1c; font: 16px/1.55 Charter, "Bitstream Charter", "Source Serif 4", Georgia, serif; }
main, header, footer { max-width: 71rem; margin: 0 auto; padding: 0 1.5rem; }
header { padding-top: 3rem; }
h1 { font-size: 2.1rem; line-height: 1.2; font-weight: 600; margin: 0 0 .6rem; max-width: 46rem; }
h2 { font-size: 1.35rem; line-height: 1.3; font-weight: 600; margin: 0 0 .6rem; }
h3 { font-size: 1.05rem; font-weight: 600; margin: 0 0 .5rem; }
p { max-width: 46rem; margin: .6rem 0; }
.lead { font-size: 1.1rem; color: #333; }
nav { border-top: 1px solid #1c1c1c; border-bottom: 1px solid #ccc; padding: .7rem 0; margin: 1.6rem 0 0; font-size: .92rem; line-height: 1.9; }
nav a { margin-right: 1.3rem; white-space: nowrap; }
a { color: #0b4f8a; text-decoration: none; }
a:hover { text-decoration: underline; }
section { padding: 2.6rem 0 .6rem; border-bottom: 1px solid #ddd; }
figure { margin: 1.4rem 0; }
figcaption { max-width: 46rem; font-size: .93rem; color: #333; margin-top: .6rem; }
.grid { display: grid; gap: .5rem .5rem; }
.cell img { display: block; width: 100%; height: auto; background: #000; }
.cell.drawing img { background: none; }
.cell img { outline: 1px solid #e2e2e2; outline-offset: -1px; }
.cell.drawing img { outline: none; }
.label { font-size: .84rem; line-height: 1.3; margin: .3rem 0 .2rem; }
.detail { color: #666; font-variant-numeric: tabular-nums; }
.differs { border-left: 3px solid #b9c6d2; padding-left: .9rem; color: #333; font-size: .95rem; }
.differs b { font-weight: 600; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .9rem; line-height: 1.4; margin: .4rem 0; font-variant-numeric: tabular-nums lining-nums; border-top: 1.5px solid #1c1c1c; border-bottom: 1.5px solid #1c1c1c; }
th { text-align: right; font-weight: 600; border-bottom: 1px solid #1c1c1c; padding: .35rem .8rem .35rem 0; vertical-align: bottom; }
td { text-align: right; padding: .22rem .8rem .22rem 0; vertical-align: top; }
td.text, th.text { text-align: left; max-width: 24rem; }
tr.group td { border-top: 1px solid #ccc; }
.files { font-size: .84rem; color: #666; }
footer { padding-top: 1.2rem; padding-bottom: 3rem; font-size: .88rem; color: #555; }
@media print { nav { display: none; } section { break-inside: avoid-page; } }
)";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// Escaped, with what stands between backquotes as code.
std::string prose(std::string_view text) {
  std::string result;
  bool code = false;
  for (const std::string& part : split(text, '`')) {
    result += code ? "<code>" + escaped(part) + "</code>" : escaped(part);
    code = !code;
  }
  return result;
}

std::string cellHtml(const Picture& picture, const std::string& folder) {
  if (picture.file.empty())
    return fmt::format("<div class=\"cell label\">{}<div class=\"detail\">{}</div></div>\n",
                       escaped(picture.label), escaped(picture.detail));
  const std::string file = escaped(folder + "/" + picture.file);
  const std::string alt = escaped(picture.label.empty() ? picture.file : picture.label);
  std::string text =
      fmt::format(R"(<div class="cell{}"><a href="{}"><img src="{}" alt="{}" loading="lazy"></a>)",
                  picture.file.ends_with(".svg") ? " drawing" : "", file, file, alt);
  if (!picture.label.empty() || !picture.detail.empty() || !picture.exr.empty()) {
    text += fmt::format(R"(<div class="label">{})", escaped(picture.label));
    if (!picture.exr.empty())
      text += fmt::format(R"( <a class="detail" href="{}">EXR</a>)", escaped(folder + "/" + picture.exr));
    if (!picture.detail.empty())
      text += fmt::format(R"(<div class="detail">{})", escaped(picture.detail)) + "</div>";
    text += "</div>";
  }
  return text + "</div>\n";
}

std::string galleryHtml(const Gallery& gallery, const std::string& folder) {
  const std::string width = gallery.cellWidth > 0 ? fmt::format("{}px", gallery.cellWidth) : "1fr";
  std::string text = fmt::format(
      "<figure>{}<div class=\"grid\" style=\"grid-template-columns: repeat({}, minmax(0, {}))\">\n",
      gallery.title.empty() ? "" : "<h3>" + escaped(gallery.title) + "</h3>", gallery.columns, width);
  for (const Picture& picture : gallery.pictures) text += cellHtml(picture, folder);
  text += "</div>\n";
  if (!gallery.caption.empty()) text += fmt::format("<figcaption>{}</figcaption>", prose(gallery.caption));
  return text + "</figure>\n";
}

/// True for a column that holds words only.
bool isText(const Table& table, size_t column) {
  for (const std::vector<Cell>& row : table.rows)
    if (row[column].number) return false;
  return true;
}

/// True when rows of the same first cell follow each other.
bool hasGroups(const Table& table) {
  for (size_t r = 1; r < table.rows.size(); ++r)
    if (table.rows[r][0] == table.rows[r - 1][0]) return true;
  return false;
}

std::string tableHtml(const Table& table, const std::string& folder) {
  std::string text = "<figure><div class=\"scroll\"><table><thead><tr>";
  std::vector<const char*> kinds;
  const bool groups = hasGroups(table);
  for (size_t i = 0; i < table.columns.size(); ++i) {
    kinds.push_back(isText(table, i) ? " class=\"text\"" : "");
    text += fmt::format("<th{}>{}</th>", kinds[i], escaped(table.columns[i].name));
  }
  text += "</tr></thead><tbody>\n";
  for (size_t r = 0; r < table.rows.size(); ++r) {
    const bool begins = groups && r > 0 && table.rows[r][0] != table.rows[r - 1][0];
    text += begins ? "<tr class=\"group\">" : "<tr>";
    for (size_t i = 0; i < table.columns.size(); ++i) {
      const bool repeats = groups && i == 0 && r > 0 && !begins;
      text += fmt::format("<td{}>{}</td>", kinds[i],
                          repeats ? "" : escaped(shown(table.rows[r][i], table.columns[i])));
    }
    text += "</tr>\n";
  }
  text += "</tbody></table></div>\n";
  text += fmt::format("<figcaption>{} <a href=\"{}/{}.csv\">CSV</a></figcaption></figure>\n",
                      prose(table.caption), escaped(folder), escaped(table.name));
  return text;
}

std::string timeText(double seconds) {
  if (seconds < 100) return fmt::format("{:.1f} s", seconds);
  return fmt::format("{:.0f} min", seconds / 60);
}

std::string sectionHtml(const Report& report) {
  std::string text =
      fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", escaped(report.part), escaped(report.title));
  for (const Block& block : report.blocks) {
    if (const auto* gallery = std::get_if<Gallery>(&block)) text += galleryHtml(*gallery, report.part);
    if (const auto* table = std::get_if<Table>(&block)) text += tableHtml(*table, report.part);
    if (const auto* paragraph = std::get_if<Paragraph>(&block))
      text += fmt::format("<p>{}</p>\n", prose(paragraph->text));
  }
  if (!report.differs.empty())
    text +=
        fmt::format("<p class=\"differs\"><b>Other than in the paper.</b> {}</p>\n", prose(report.differs));
  return text + fmt::format(
                    "<p class=\"files\">All numbers: <a href=\"{0}/{0}.json\">JSON</a>. Made in "
                    "{1}.</p>\n</section>\n",
                    escaped(report.part), timeText(report.seconds));
}

}  // namespace

std::string htmlOf(const Page& page) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>Translucent objects with variable sizes, "
      "measured"
      "</title>\n<style>{}</style>\n</head>\n<body>\n<header>\n",
      kStyle);
  text +=
      "<h1>Real-time rendering of translucent objects with variable sizes: reproduced, and measured</h1>\n"
      "<p class=\"lead\">Every figure and table of Yao and Wang (2009), made anew by Lychnite, each method "
      "held against Monte Carlo light transport. What the paper judged by eye has numbers here.</p>\n";
  text += fmt::format(
      "<p class=\"files\">Lychnite {}, {}, on {}{}.</p>\n<nav>\n", escaped(page.version), escaped(page.date),
      escaped(page.device),
      page.quick ? ". Quick version: small pictures, few photons, errors uncertain accordingly" : "");
  for (const Report& report : page.reports)
    text += fmt::format("<a href=\"#{}\">{}</a>\n", escaped(report.part), escaped(report.title));
  text += "</nav>\n</header>\n<main>\n";
  for (const Report& report : page.reports) text += sectionHtml(report);
  text += "</main>\n<footer>\n";
  if (!page.missing.empty()) {
    text += "<p>Not made yet:";
    for (const auto& [name, title] : page.missing)
      text += fmt::format(" {} ({});", escaped(title), escaped(name));
    text.back() = '.';
    text += " <code>lychnite paper</code> on the same folder goes on.</p>\n";
  }
  text +=
      "<p>The paper: Yao and Wang, <i>Real-Time Rendering of Translucent Objects with Variable Sizes</i>, "
      "2009. "
      "Pictures are linear radiance through the sRGB curve at the stated exposure; the "
      "EXR files hold the radiance itself with the scene that made it.</p>\n</footer>\n</body>\n</html>\n";
  return text;
}

}  // namespace lychnite::paper
