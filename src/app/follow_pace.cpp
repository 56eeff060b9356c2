#include "lychnite/app/follow_pace.h"

#include <utility>

namespace lychnite {

void FollowPace::measured(double seconds, double share) {
  const double full = seconds / (share * share), before = share_;
  for (const double next : {1.0, 0.75, 0.5, 0.375, 0.25}) {
    // Growing asks for more room than staying, or the share would swing.
    const double most = next > before ? 0.7 * kPictureSeconds : 1.3 * kPictureSeconds;
    share_ = next;
    if (full * next * next <= most) return;
  }
}

bool FollowPace::follows(const void* picture, bool behind, double now) {
  const bool arrived = std::exchange(picture_, picture) != picture, was = std::exchange(behind_, behind);
  if (!behind || !was || arrived) since_ = now;
  if (behind && now - since_ > kMostLag) slowUntil_ = now + kRetryAfter;
  return now >= slowUntil_;
}

}  // namespace lychnite
