#include "lychnite/app/paper.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

#include "app/date.h"
#include "app/paper/page.h"
#include "app/paper/parts.h"
#include "gpu/shader_source.h"
#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/gpu/context.h"

namespace lychnite {
namespace {

namespace fs = std::filesystem;
using namespace paper;

constexpr const char* kModelFiles[] = {"bunny.ply", "dragon.ply"};

/// What tells the files of the models from others of the same names.
std::string modelsText(const fs::path& folder) {
  std::string text;
  std::error_code code;
  for (const char* name : kModelFiles)
    if (const auto bytes = fs::file_size(folder / name, code); !code)
      text += fmt::format(" {} {}", name, bytes);
  return text;
}

/// What makes the pictures: the version, and the program and shaders themselves, which change more often. A
/// file that cannot be read is left out.
std::string programText() {
  std::string text = versionText();
  std::vector<fs::path> files{"/proc/self/exe"};
  for (const auto& entry : fs::recursive_directory_iterator(gpu::findShaderDir()))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    text += hashOf(bytes);
  }
  return hashOf(text);
}

/// The report of a part as it is on disk; nothing when there is none that can be read.
std::optional<Report> readReport(const fs::path& path) {
  std::ifstream file(path);
  if (!file) return {};
  try {
    return reportFrom(Json::parse(file));
  } catch (const Json::exception&) {
    return {};
  }
}

void makeFolder(const fs::path& folder) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (code || !fs::is_directory(folder))
    throw Error({.where = folder.string(),
                 .expected = "a folder to write to",
                 .found = code ? code.message() : "a file",
                 .todo = ""});
}

class Maker {
 public:
  Maker(const PaperSettings& settings, const Progress& progress)
      : settings_(settings),
        progress_(progress),
        context_({.device = settings.device}, settings.log),
        maker_({.useCurrentContext = true, .log = settings.log}),
        studio_(settings_, maker_, context_.device().renderer, programText()) {}

  PaperResult run() {
    PaperResult result{.page = settings_.output / "index.html"};
    std::vector<const Part*> wanted;
    for (const Part& part : parts()) {
      if (!isWanted(part)) continue;
      if (isFinished(part))
        result.kept.push_back(part.name);
      else
        wanted.push_back(&part);
    }
    writePage(result.page);
    double all = 0, done = 0;
    for (const Part* part : wanted) all += part->cost;
    for (const Part* part : wanted) {
      make(*part, done / all, part->cost / all);
      done += part->cost;
      result.made.push_back(part->name);
      writePage(result.page);
    }
    return result;
  }

 private:
  bool isWanted(const Part& part) const {
    return settings_.only.empty() ||
           std::find(settings_.only.begin(), settings_.only.end(), part.name) != settings_.only.end();
  }

  fs::path jsonOf(const Part& part) const {
    return settings_.output / part.name / fmt::format("{}.json", part.name);
  }

  std::string stampOf(const Part& part) const {
    return hashOf(fmt::format("{} {} {} {} {}{}", studio_.program(), part.name, part.revision,
                              settings_.quick, studio_.device(), modelsText(settings_.models)));
  }

  bool isFinished(const Part& part) const {
    const auto report = readReport(jsonOf(part));
    return report && report->stamp == stampOf(part);
  }

  /// Makes a part in its share of the whole: `before` is done, `share` is it.
  void make(const Part& part, double before, double share) {
    const fs::path folder = settings_.output / part.name;
    makeFolder(folder);
    const auto older = readReport(jsonOf(part));
    Report report{.part = part.name, .title = part.title, .stamp = stampOf(part)};
    studio_.begin(folder, part.steps(studio_), Progress([=, this, &part](const Progress::Update& update) {
                    return progress_.update({.what = update.what,
                                             .fraction = before + share * update.fraction,
                                             .detail = fmt::format("{}: {}", part.name, update.detail)});
                  }));
    context_.makeCurrent();  // a part before may have drawn in one of its own
    part.make(studio_, report);
    report.seconds = studio_.seconds();
    for (const Block& block : report.blocks)
      if (const auto* table = std::get_if<Table>(&block))
        writeTextAtomically(studio_.file(table->name + ".csv"), csvOf(*table));
    report.files.assign(studio_.files().begin(), studio_.files().end());
    writeTextAtomically(jsonOf(part),
                        toJson(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    if (older) removeStale(folder, older->files);
  }

  void removeStale(const fs::path& folder, const std::vector<std::string>& older) const {
    std::error_code ignored;
    for (const std::string& name : older)
      if (!studio_.files().contains(name) && fs::path(name).filename() == name)
        fs::remove(folder / name, ignored);
  }

  void writePage(const fs::path& path) const {
    Page page{
        .version = versionText(), .date = today(), .device = studio_.device(), .quick = settings_.quick};
    for (const Part& part : parts()) {
      if (auto report = readReport(jsonOf(part)); report && report->stamp == stampOf(part))
        page.reports.push_back(std::move(*report));
      else
        page.missing.emplace_back(part.name, part.title);
    }
    writeTextAtomically(path, htmlOf(page));
  }

  const PaperSettings& settings_;
  const Progress& progress_;
  gpu::Context context_;  // before the maker, which draws in it
  ImageMaker maker_;
  Studio studio_;
};

}  // namespace

std::vector<PaperPartName> paperParts() {
  std::vector<PaperPartName> names;
  for (const Part& part : parts()) names.push_back({part.name, part.title});
  return names;
}

void validate(const PaperSettings& settings) {
  std::vector<std::string> names;
  for (const Part& part : parts()) names.emplace_back(part.name);
  for (const std::string& name : settings.only) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    std::string all;
    for (const std::string& known : names) all += (all.empty() ? "" : ", ") + known;
    throw Error(
        {.where = "only", .expected = "any of " + all, .found = fmt::format("'{}'", name), .todo = ""},
        Error::Kind::kUsage);
  }
  if (!settings.models.empty() && !fs::is_directory(settings.models))
    throw Error({.where = "models",
                 .expected = "a folder",
                 .found = fmt::format("'{}'", settings.models.string()),
                 .todo = ""},
                Error::Kind::kUsage);
}

PaperResult makePaper(const PaperSettings& settings, const Progress& progress) {
  validate(settings);
  makeFolder(settings.output);
  return Maker(settings, progress).run();
}

}  // namespace lychnite
