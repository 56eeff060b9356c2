#include "reference/camera_receivers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace lychnite {

namespace {

constexpr double kSubsample[4][2] = {{.25, .25}, {.75, .25}, {.25, .75}, {.75, .75}};
// A pixel is one surface where its samples' normals lie within about 18 degrees and their depths within what
// the pixel's footprint on a surface 80 degrees to the view could differ.
constexpr float kSimilarNormal = 0.95f;
constexpr double kDepthPerFootprint = 6.0;
// Cosines to the camera so close together, the less the flatter, have one exit lobe. As
// shaders/pass/receiver.glsl.
constexpr float kLobeSpread = 0.25f;

struct Caster {
  const RayScene& rays;
  CameraFrame camera;
  double footprint;  ///< width of a pixel at unit depth

  Caster(const RayScene& scene, int width, int height)
      : rays(scene), camera(scene.camera(width, height)), footprint(2 * camera.tanHalfFovY / height) {}

  Receiver cast(double x, double y) const {
    Receiver receiver;
    const glm::dvec3 direction = camera.direction(x, y);
    receiver.hit = rays.nearest(glm::vec3(camera.position), glm::vec3(direction));
    if (!receiver.hit) return receiver;
    receiver.view = glm::vec3(-direction);
    receiver.depth = receiver.hit.distance * float(glm::dot(direction, camera.forward));
    receiver.normal = rays.mesh(receiver.hit.object).shadingNormal(receiver.hit);
    // Behind the horizon an interpolated normal means nothing: the geometric one, turned to the camera,
    // stands in.
    if (glm::dot(receiver.normal, receiver.view) < 1e-3f)
      receiver.normal =
          glm::dot(receiver.hit.normal, receiver.view) < 0 ? -receiver.hit.normal : receiver.hit.normal;
    return receiver;
  }

  bool similar(const Receiver& a, const Receiver& b) const {
    return b.hit.object == a.hit.object && glm::dot(a.normal, b.normal) > kSimilarNormal &&
           std::abs(a.depth - b.depth) < kDepthPerFootprint * footprint * a.depth;
  }

  static bool oneLobe(const std::array<Receiver, 4>& samples) {
    float least = 1, most = 0;
    for (const Receiver& sample : samples) {
      const float cosO = glm::dot(sample.normal, sample.view);
      least = std::min(least, cosO);
      most = std::max(most, cosO);
    }
    return most - least < kLobeSpread * least * least;
  }

  /// Appends the pixel's receivers; returns how many of its samples hit something.
  uint8_t pixel(uint32_t index, std::vector<Receiver>& out) const {
    const double x = index % uint32_t(camera.width), y = index / uint32_t(camera.width);
    std::array<Receiver, 4> samples;
    uint8_t covered = 0;
    bool one = true;
    for (int i = 0; i < 4; ++i) {
      samples[size_t(i)] = cast(x + kSubsample[i][0], y + kSubsample[i][1]);
      covered += samples[size_t(i)].hit ? 1 : 0;
      one = one && samples[size_t(i)].hit && similar(samples[0], samples[size_t(i)]);
    }
    if (one && oneLobe(samples)) {
      Receiver centre = cast(x + 0.5, y + 0.5);
      if (centre.hit && similar(samples[0], centre)) {
        centre.normal =
            glm::normalize(samples[0].normal + samples[1].normal + samples[2].normal + samples[3].normal);
        centre.pixel = index;
        out.push_back(centre);
        return covered;
      }
    }
    for (Receiver& sample : samples) {
      if (!sample.hit) continue;
      sample.pixel = index;
      sample.weight = 0.25f;
      out.push_back(sample);
    }
    return covered;
  }
};

}  // namespace

CameraReceivers findReceivers(const RayScene& scene, int width, int height) {
  const Caster caster(scene, width, height);
  CameraReceivers result;
  result.width = width;
  result.height = height;
  result.covered.resize(size_t(width) * size_t(height));
  std::vector<std::vector<Receiver>> rows{size_t(height)};
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const auto index = uint32_t(y) * uint32_t(width) + uint32_t(x);
      result.covered[index] = caster.pixel(index, rows[size_t(y)]);
    }
  });
  size_t count = 0;
  for (const auto& row : rows) count += row.size();
  result.receivers.reserve(count);
  for (const auto& row : rows) result.receivers.insert(result.receivers.end(), row.begin(), row.end());
  return result;
}

void addGeometryLayers(Image& image, const CameraReceivers& receivers, const RayScene& scene,
                       const RenderSettings& settings) {
  auto& alpha = image.addChannel("A");
  for (size_t i = 0; i < alpha.size(); ++i) alpha[i] = receivers.alpha(i);
  const bool depth = settings.wants("depth"), normal = settings.wants("normal");
  if (depth) image.addChannel("depth.Z");
  constexpr const char* kNormal[] = {"normal.X", "normal.Y", "normal.Z"};
  if (normal)
    for (const char* name : kNormal) image.addChannel(name);
  for (const Receiver& receiver : receivers.receivers) {
    const float share = receiver.weight / receivers.alpha(receiver.pixel);
    if (depth) image.addChannel("depth.Z")[receiver.pixel] += share * receiver.depth * float(scene.unit());
    if (normal)
      for (int i = 0; i < 3; ++i) image.addChannel(kNormal[i])[receiver.pixel] += share * receiver.normal[i];
  }
}

}  // namespace lychnite
