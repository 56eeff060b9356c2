#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "lychnite/base/error.h"
#include "lychnite/technique/renderer.h"
#include "unit/scene/scenes.h"

namespace lychnite {

/// Tests that render: one renderer in a debug context, where an OpenGL error is a failure; skipped where
/// there is none.
class RenderTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      renderer_ = std::make_unique<Renderer>(RendererOptions{.device = "cpu", .debug = true, .log = {}});
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  Image render(const Scene& scene, const RenderSettings& settings) {
    return renderer_->render(scene, settings);
  }
  /// How often a pass ran in the last render; -1 when it was not part of it.
  int runs(const std::string& pass) const {
    for (const RenderStats::Pass& each : renderer_->stats().passes)
      if (each.name == pass) return each.runs;
    return -1;
  }
  std::unique_ptr<Renderer> renderer_;
};

inline RenderSettings smallPicture(Method method = Method::kAdaptive, int size = 96) {
  RenderSettings settings;
  settings.width = settings.height = size;
  settings.method = method;
  return settings;
}

inline Components only(const std::string& list) {
  return parseComponents(list, "");
}

inline size_t pixelAt(const Image& image, int x, int y) {
  return size_t(y) * size_t(image.width()) + size_t(x);
}

inline glm::dvec3 centreOf(const Image& image, const std::string& layer = "") {
  return image.rgb(pixelAt(image, image.width() / 2, image.height() / 2), layer);
}

inline double meanOf(const Image& image) {
  double sum = 0;
  for (const char* channel : {"R", "G", "B"})
    for (const float v : image.channel(channel)) sum += double(v);
  return sum / double(3 * image.pixelCount());
}

/// Largest difference of the colours over the largest colour of b.
inline double difference(const Image& a, const Image& b) {
  double largest = 0, error = 0;
  for (const char* channel : {"R", "G", "B"})
    for (size_t i = 0; i < b.pixelCount(); ++i) {
      largest = std::max(largest, double(b.channel(channel)[i]));
      error = std::max(error, double(std::abs(a.channel(channel)[i] - b.channel(channel)[i])));
    }
  return error / largest;
}

/// A camera far in front of the origin that sees `span` mm across there, nearly parallel.
inline PinholeCamera distantCamera(const glm::dvec3& towards, double span) {
  PinholeCamera camera;
  camera.position = 200 * span * towards;
  camera.fov = 2 * std::atan(0.5 / 200) * 57.29577951308232;
  return camera;
}

}  // namespace lychnite
