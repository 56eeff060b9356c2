#include "profile_queue.h"

#include <fmt/format.h>

#include "lychnite/app/background.h"

namespace lychnite::viewer {
namespace {

/// What a measurement depends on; scaling lengths and coefficients together changes nothing.
std::string keyOf(const Coefficients& m) {
  const Rgb albedo = m.albedo();
  return fmt::format("{:.12g} {:.12g} {:.12g} {:.12g} {:.12g}", albedo.x, albedo.y, albedo.z, m.g, m.eta);
}

}  // namespace

ProfileMaker ProfileQueue::maker() {
  return [this](const ProfileRequest& request, const Progress&) { return make(request); };
}

std::unique_ptr<Profile> ProfileQueue::make(const ProfileRequest& request) {
  if (request.kind != ProfileKind::kTabulated) return makeProfile(request.kind, request.medium);
  const std::string key = keyOf(request.medium);
  const auto known = known_.find(key);
  if (known != known_.end() && known->second) return store_.make(request);
  if (known == known_.end() && !running_.contains(key))
    running_[key] = std::async(std::launch::async, [this, request] {
      lowerThreadPriority();
      store_.make(request);
    });
  return makeProfile(ProfileKind::kBetterDipole, request.medium);
}

bool ProfileQueue::takeArrived() {
  bool arrived = false;
  for (auto entry = running_.begin(); entry != running_.end();) {
    if (entry->second.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      ++entry;
      continue;
    }
    try {
      entry->second.get();
      known_[entry->first] = arrived = true;
    } catch (const std::exception&) {
      known_[entry->first] = false;
    }
    entry = running_.erase(entry);
  }
  return arrived;
}

}  // namespace lychnite::viewer
