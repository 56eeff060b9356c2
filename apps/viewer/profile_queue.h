#pragma once

#include <future>
#include <map>
#include <string>

#include "lychnite/app/profile_store.h"

namespace lychnite::viewer {

/// Profiles for a window that must not wait: a measured one that is not known yet is measured on another
/// thread, and the better dipole stands in for it until then.
class ProfileQueue {
 public:
  /// Must not outlive the queue.
  ProfileMaker maker();
  bool busy() const { return !running_.empty(); }
  /// True once after measurements came in: pictures made with stand-ins should be made again.
  bool takeArrived();

 private:
  std::unique_ptr<Profile> make(const ProfileRequest& request);
  ProfileStore store_;
  std::map<std::string, std::future<void>> running_;
  std::map<std::string, bool> known_;  ///< measured, or (false) found to be impossible
};

}  // namespace lychnite::viewer
