#pragma once

namespace lychnite {

/// Whether pictures that are solved behind a window keep up with a scene in motion, and how coarse they are
/// made for it. Times are seconds on the caller's clock.
class FollowPace {
 public:
  /// The longest that the picture shown may stay behind the scene without a newer one.
  static constexpr double kMostLag = 0.6;
  /// How long it is not tried again after that.
  static constexpr double kRetryAfter = 60;
  /// What a picture of a solved scene may take while things move.
  static constexpr double kPictureSeconds = 0.06;

  /// A picture of `share` of the full resolution's width took so long.
  void measured(double seconds, double share);
  /// The share of the full width to make pictures of a moving scene at.
  double share() const { return share_; }

  /// Asked once for each frame, with the picture that is shown (any address that tells one from another) and
  /// whether it is behind the scene. False from when it was so for kMostLag until kRetryAfter later.
  bool follows(const void* picture, bool behind, double now);

 private:
  double share_ = 0.5;
  const void* picture_ = nullptr;
  double since_ = 0, slowUntil_ = -1;
  bool behind_ = false;
};

}  // namespace lychnite
