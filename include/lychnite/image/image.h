#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lychnite {

/// A float image of named channels, top row first, as in an EXR file. Colour is "R", "G", "B": the pixel's radiance,
/// the background showing through where coverage "A" is below 1. AOVs are "<layer>.R|G|B" or "<layer>.<NAME>".
/// `metadata` says how the image was made (EXR string attributes).
class Image {
 public:
  Image() = default;
  Image(int width, int height) : width_(width), height_(height) {}

  int width() const { return width_; }
  int height() const { return height_; }
  size_t pixelCount() const { return size_t(width_) * size_t(height_); }
  bool empty() const { return pixelCount() == 0; }

  bool has(std::string_view channel) const { return channels_.find(channel) != channels_.end(); }
  /// The channel's pixels, row by row; throws Error when there is none of that name.
  const std::vector<float>& channel(std::string_view name) const;
  /// The channel's pixels, made (zero) when there is none of that name.
  std::vector<float>& addChannel(const std::string& name);
  const std::map<std::string, std::vector<float>, std::less<>>& channels() const { return channels_; }

  /// Colour of pixel `i` of a layer ("" for the main picture, "multiple", ...).
  glm::vec3 rgb(size_t i, std::string_view layer = "") const;
  void setRgb(size_t i, const glm::vec3& value, const std::string& layer = "");
  bool hasRgb(std::string_view layer = "") const;

  std::map<std::string, std::string> metadata;

 private:
  int width_ = 0, height_ = 0;
  std::map<std::string, std::vector<float>, std::less<>> channels_;
};

}  // namespace lychnite
