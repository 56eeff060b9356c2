#include <fmt/format.h>
#include <cmath>

#include <cstdlib>
#include <glm/common.hpp>

#include "lychnite/base/error.h"
#include "reference/walk.h"

namespace lychnite {

glm::vec3 LayerMean::variance(size_t pixel) const {
  const glm::vec3 m = mean(pixel);
  if (batches_ < 2) return m * m;
  const glm::vec3 spread = squares_[pixel] / float(counted_) - m * m;
  return glm::max(spread, glm::vec3(0)) * float(counted_ / ((batches_ - 1) * weight_));
}

void LayerMean::save(Image& image, const std::string& name) const {
  for (const char* channel : {".R", ".G", ".B"}) {
    image.addChannel(name + channel);
    image.addChannel(name + "-squares" + channel);
  }
  for (size_t i = 0; i < sum_.size(); ++i) {
    image.setRgb(i, sum_[i], name);
    image.setRgb(i, squares_[i], name + "-squares");
  }
  image.metadata[name] = fmt::format("{} {} {}", weight_, counted_, batches_);
}

void LayerMean::load(const Image& image, const std::string& name) {
  const auto numbers = image.metadata.find(name);
  char* end = nullptr;
  double value[3] = {-1, -1, -1};
  const char* text = numbers == image.metadata.end() ? "" : numbers->second.c_str();
  for (double& v : value) {
    v = std::strtod(text, &end);
    text = end;
  }
  if (!image.hasRgb(name) || !image.hasRgb(name + "-squares") || !(value[0] > 0) || !(value[1] >= 0) ||
      !(value[2] >= 0))
    throw Error({.where = "--resume",
                 .expected = fmt::format("a walk's picture that holds its state ('{}')", name),
                 .found = "none",
                 .todo = "resume from an EXR that the walk wrote for the same scene and settings"});
  for (size_t i = 0; i < sum_.size(); ++i) {
    sum_[i] = image.rgb(i, name);
    squares_[i] = image.rgb(i, name + "-squares");
  }
  weight_ = value[0];
  counted_ = value[1];
  batches_ = value[2];
}

}  // namespace lychnite
