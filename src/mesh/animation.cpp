#include "lychnite/mesh/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>

#include "lychnite/base/error.h"
#include "mesh/animation_data.h"
#include "mesh/topology.h"

namespace lychnite {
namespace {

constexpr int kLooks = 24;         // moments of a clip at which its reach is looked for,
constexpr double kMargin = 1.05;   // and how much farther it may go between them
constexpr double kFarthest = 1e6;  // extents of the mesh at rest; what lies farther is an error of the file

double lengthOf(const AnimationData::Clip& clip) {
  double seconds = 0;
  for (const auto& sampler : clip.samplers) seconds = std::max(seconds, sampler.times.back());
  return seconds;
}

/// Infinite when one of them is not a number.
double farthest(const std::vector<glm::vec3>& positions, const glm::dvec3& centre) {
  double square = 0;
  for (const glm::dvec3 p : positions) {
    const double each = glm::dot(p - centre, p - centre);
    square = std::isnan(each) ? std::numeric_limits<double>::infinity() : std::max(square, each);
  }
  return std::sqrt(square);
}

/// `reach` in extents of the mesh at rest.
void refuseFar(double reach, const std::string& clip, double seconds) {
  if (reach <= kFarthest) return;
  throw Error({.where = fmt::format("{} at {:.3g} s", clip, seconds),
               .expected = fmt::format("vertices within {:g} times the model's size", kFarthest),
               .found = std::isfinite(reach) ? fmt::format("one at {:.2g} times", reach)
                                             : "NaN, infinity or a number past the range of floats",
               .todo = "export the animation again"});
}

}  // namespace

struct MeshAnimation::Impl {
  AnimationData data;
  std::vector<Clip> clips;
  std::vector<uint32_t> welded;  ///< for normals that the file lacks: the first vertex at the same place
  std::vector<double> reach;     ///< of each clip, 0 before it was looked for
  std::mutex mutex;

  double reachAbout(const Bounds& rest, size_t clip);
};

double MeshAnimation::Impl::reachAbout(const Bounds& rest, size_t clip) {
  const std::lock_guard lock(mutex);
  if (reach[clip] > 0) return reach[clip];
  for (int i = 0; i < kLooks; ++i) {
    const double seconds = clips[clip].seconds * i / (kLooks - 1);
    const double each = farthest(posedVertices(data, clip, seconds).positions, rest.centre());
    // A moment that is an error hides none of the others.
    if (each <= kFarthest * glm::length(rest.extent())) reach[clip] = std::max(reach[clip], kMargin * each);
  }
  return reach[clip];
}

MeshAnimation::MeshAnimation(AnimationData data, std::shared_ptr<const Mesh> rest)
    : impl_(std::make_unique<Impl>()), rest_(std::move(rest)) {
  impl_->data = std::move(data);
  for (const auto& clip : impl_->data.clips) impl_->clips.push_back({clip.name, lengthOf(clip)});
  impl_->reach.assign(impl_->clips.size(), 0);
  if (impl_->data.mesh.normals.empty())
    impl_->welded = firstEquals(posedVertices(impl_->data, {}, 0).positions);
}

MeshAnimation::~MeshAnimation() = default;

const std::vector<MeshAnimation::Clip>& MeshAnimation::clips() const {
  return impl_->clips;
}

std::shared_ptr<const Mesh> MeshAnimation::pose(size_t clip, double seconds) const {
  Impl& all = *impl_;
  if (clip >= all.clips.size())
    throw Error({.where = "animation",
                 .expected = "one of " + std::to_string(all.clips.size()),
                 .found = "number " + std::to_string(clip + 1),
                 .todo = ""},
                Error::Kind::kUsage);
  PosedVertices posed = posedVertices(all.data, clip, seconds);
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = std::move(posed.positions);
  mesh->triangles = all.data.mesh.triangles;
  if (posed.normals.empty()) {
    std::vector<glm::uvec3> triangles = mesh->triangles;
    for (glm::uvec3& t : triangles) t = {all.welded[t.x], all.welded[t.y], all.welded[t.z]};
    const std::vector<glm::vec3> normals = angleWeightedNormals(mesh->positions, triangles);
    for (const uint32_t first : all.welded) mesh->normals.push_back(normals[first]);
  } else {
    mesh->normals = std::move(posed.normals);
  }
  Extent extent{extentOf(*rest_).bounds, 0};
  const double reach = farthest(mesh->positions, extent.bounds.centre());
  refuseFar(reach / glm::length(extent.bounds.extent()), all.clips[clip].name, seconds);
  extent.radius = std::max(all.reachAbout(extent.bounds, clip), reach);
  mesh->extent = extent;
  return mesh;
}

}  // namespace lychnite
