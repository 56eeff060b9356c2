#include "lychnite/app/profile_store.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "app/profile_file.h"
#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/reference/measure_profile.h"

namespace lychnite {
namespace {

namespace fs = std::filesystem;

/// Nine digits: the same material in another unit of length differs by rounding only.
double rounded(double value) {
  return std::strtod(fmt::format("{:.9g}", value).c_str(), nullptr);
}

ProfileMeasurement measurementOf(const Coefficients& medium) {
  ProfileMeasurement m{.g = rounded(medium.g), .eta = rounded(medium.eta)};
  const Rgb albedo = medium.albedo();
  for (int c = 0; c < 3; ++c) m.albedo[c] = rounded(albedo[c]);
  return m;
}

/// The file's text, nothing where there is none.
std::optional<std::string> textOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void keepOnDisk(const fs::path& path, const std::string& text, const LogSink& log) {
  try {
    std::error_code code;
    fs::create_directories(path.parent_path(), code);
    writeTextAtomically(path, text);
  } catch (const Error& error) {
    logTo(log, LogLevel::kInfo, fmt::format("the measured profile is not kept on disk: {}", error.what()));
  }
}

}  // namespace

fs::path defaultCacheFolder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) return fs::path(cache) / "lychnite";
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "lychnite";
  return {};
}

ProfileStore::ProfileStore(fs::path folder, LogSink log) : folder_(std::move(folder)), log_(std::move(log)) {}

std::unique_ptr<Profile> ProfileStore::make(const ProfileRequest& request, const Progress& progress) {
  if (request.kind != ProfileKind::kTabulated) return makeProfile(request.kind, request.medium);
  // Nothing scatters: nothing to measure.
  if (request.medium.sigma_s == Rgb(0)) return makeDipole(request.medium);
  return makeTabulated(*measured(request.medium, progress), request.orders, request.medium);
}

ProfileMaker ProfileStore::maker() {
  return [this](const ProfileRequest& request, const Progress& progress) { return make(request, progress); };
}

std::shared_ptr<const MeasuredProfile> ProfileStore::measured(const Coefficients& medium,
                                                              const Progress& progress) {
  const ProfileMeasurement m = measurementOf(medium);
  const std::string key = profileFileKey(m);
  const std::lock_guard lock(mutex_);
  auto& kept = kept_[key];
  if (!kept) kept = readOrMeasure(key, medium, progress);
  return kept;
}

std::shared_ptr<const MeasuredProfile> ProfileStore::readOrMeasure(const std::string& key,
                                                                   const Coefficients& medium,
                                                                   const Progress& progress) const {
  const fs::path path = folder_.empty() ? fs::path() : folder_ / profileFileName(key);
  if (const auto text = path.empty() ? std::nullopt : textOf(path)) {
    if (auto read = parseProfileFile(*text, key)) return std::make_shared<MeasuredProfile>(std::move(*read));
    logTo(log_, LogLevel::kWarning,
          fmt::format("{} is damaged; the profile is measured anew", path.string()));
  }
  auto made = std::make_shared<MeasuredProfile>(measureProfile(measurementOf(medium), progress));
  if (!path.empty()) keepOnDisk(path, profileFileText(*made, key), log_);
  return made;
}

}  // namespace lychnite
