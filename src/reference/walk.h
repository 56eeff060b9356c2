#pragma once

#include "lychnite/reference/reference.h"
#include "reference/camera_receivers.h"
#include "reference/walk_photon.h"

namespace lychnite {

/// Means over repeated, independent estimates of a picture layer, pixel by pixel, and the variance of the
/// mean.
class LayerMean {
 public:
  explicit LayerMean(size_t pixels) : sum_(pixels), squares_(pixels) {}

  /// `value` is the mean of a batch of `weight` (photons, passes). Batches that do not count for the variance
  /// (an interrupted one) only join the mean.
  void add(size_t pixel, const glm::vec3& value, double weight, bool counts = true) {
    sum_[pixel] += value * float(weight);
    if (counts) squares_[pixel] += value * value * float(weight);
  }
  void finishBatch(double weight, bool counts = true) {
    weight_ += weight;
    if (counts) {
      counted_ += weight;
      batches_ += 1;
    }
  }
  double weight() const { return weight_; }
  double batches() const { return batches_; }
  glm::vec3 mean(size_t pixel) const { return weight_ > 0 ? sum_[pixel] / float(weight_) : glm::vec3(0); }
  /// Of the mean; the mean squared where there are fewer than two batches to judge by.
  glm::vec3 variance(size_t pixel) const;

  /// The state as layers `name` and `name`-squares, and back.
  void save(Image& image, const std::string& name) const;
  void load(const Image& image, const std::string& name);

 private:
  std::vector<glm::vec3> sum_, squares_;
  double weight_ = 0, counted_ = 0, batches_ = 0;
};

/// The truth: Monte Carlo transport of all orders. docs/physics.md says what is exact in it and what is not.
Image renderWalk(const RayScene& rays, const CameraReceivers& receivers, const RenderSettings& settings,
                 const ReferenceOptions& options, const Progress& progress, const LogSink& log);

}  // namespace lychnite
