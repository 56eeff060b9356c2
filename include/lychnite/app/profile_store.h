#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "lychnite/base/log.h"
#include "lychnite/optics/tabulated_profile.h"

namespace lychnite {

/// $XDG_CACHE_HOME/lychnite, else ~/.cache/lychnite; empty where neither variable is set.
std::filesystem::path defaultCacheFolder();

/// Makes profiles of every kind, the measured ones by Monte Carlo transport when first asked for.
/// Measurements are kept in memory and in `folder`, one file a material, named by a hash of albedo, g and eta
/// (size does not matter). A damaged file is measured anew with a warning; where the folder cannot be
/// written, or `folder` is empty, they stay in memory. May be called from several threads.
class ProfileStore {
 public:
  explicit ProfileStore(std::filesystem::path folder = defaultCacheFolder(), LogSink log = {});

  /// Throws what measureProfile throws.
  std::unique_ptr<Profile> make(const ProfileRequest& request, const Progress& progress = {});
  /// make() of this store, which must outlive it.
  ProfileMaker maker();

 private:
  std::shared_ptr<const MeasuredProfile> measured(const Coefficients& medium, const Progress& progress);
  std::shared_ptr<const MeasuredProfile> readOrMeasure(const std::string& key, const Coefficients& medium,
                                                       const Progress& progress) const;

  std::filesystem::path folder_;
  LogSink log_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const MeasuredProfile>> kept_;
};

}  // namespace lychnite
