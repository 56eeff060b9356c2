#include "lychnite/image/image.h"

#include <cassert>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

constexpr const char* kColourNames[] = {"R", "G", "B"};

std::string channelName(std::string_view layer, const char* colour) {
  return layer.empty() ? std::string(colour) : std::string(layer) + "." + colour;
}

}  // namespace

const std::vector<float>& Image::channel(std::string_view name) const {
  const auto found = channels_.find(name);
  if (found != channels_.end()) return found->second;
  std::string present;
  for (const auto& [key, pixels] : channels_) present += (present.empty() ? "" : ", ") + key;
  throw Error({.where = "image",
               .expected = "a channel '" + std::string(name) + "'",
               .found = present.empty() ? "no channel at all" : "only " + present,
               .todo = ""});
}

std::vector<float>& Image::addChannel(const std::string& name) {
  std::vector<float>& pixels = channels_[name];
  pixels.resize(pixelCount());
  return pixels;
}

glm::vec3 Image::rgb(size_t i, std::string_view layer) const {
  assert(i < pixelCount());
  glm::vec3 value;
  for (int c = 0; c < 3; ++c) value[c] = channel(channelName(layer, kColourNames[c]))[i];
  return value;
}

void Image::setRgb(size_t i, const glm::vec3& value, const std::string& layer) {
  assert(i < pixelCount());
  for (int c = 0; c < 3; ++c) addChannel(channelName(layer, kColourNames[c]))[i] = value[c];
}

bool Image::hasRgb(std::string_view layer) const {
  for (const char* colour : kColourNames)
    if (!has(channelName(layer, colour))) return false;
  return true;
}

}  // namespace lychnite
