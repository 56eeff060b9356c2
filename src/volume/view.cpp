#include "volume/view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "lychnite/optics/fresnel.h"
#include "volume/interruptible.h"

namespace lychnite::volume {

namespace {

constexpr size_t kMostBytes = 512u << 20;  // of what is kept: some 1.2 million pixels
// Least cosine of a facet's normal to its corners': below it is left as it is, above it is smooth.
constexpr float kCreased = 0.72f, kSmooth = 0.85f;
constexpr double kSameCamera = 1e-9;  // lengths over the scene's: what sizes round to

/// A hit moved onto the smooth surface that the interpolated normals tell of, or left where it is if that
/// lies inside: from there neighbouring facets cast no shadow [Hanika2021]. Facets whose corners' normals are
/// far from their own are taken as they are: a box is not round, whatever normals its file has.
SurfacePoint onSmoothSurface(const RayMesh& mesh, const RayHit& hit, const glm::vec3& normal) {
  const glm::uvec3 corners = (*mesh.triangles)[hit.triangle];
  const glm::vec3 weights(1 - hit.u - hit.v, hit.u, hit.v);
  glm::vec3 move(0);
  float agreement = 1;
  for (int c = 0; c < 3; ++c) {
    const glm::vec3& there = mesh.normals[corners[c]];
    const float below = glm::dot(mesh.positions[corners[c]] - hit.position, there);
    if (below > 0) move += weights[c] * below * there;
    agreement = std::fmin(agreement, glm::dot(there, hit.normal));
  }
  const float smooth = glm::smoothstep(kCreased, kSmooth, agreement);
  return {hit.position + smooth * move, glm::normalize(glm::mix(hit.normal, normal, smooth))};
}

/// Finds the shares and spots of pixels. Where a surface turns away from the eye or ends, or pixels are
/// larger than voxels, a pixel spans much of it: a raster of rays stands for it there, so that the mean is
/// over the pixel, as that of the walk's splats.
class Looker {
 public:
  Looker(const RayScene& rays, const World& world, const CameraFrame& camera,
         const std::vector<uint32_t>& firstNode)
      : rays_(rays),
        world_(world),
        camera_(camera),
        pixel_(float(2 * camera.tanHalfFovY / camera.height)),
        firstNode_(firstNode) {}

  /// Of one pixel, whose receivers are given.
  void look(const Receiver* begin, const Receiver* end) {
    shares_.clear();
    spots_.clear();
    if (end - begin == 1 && isPlain(*begin)) return add(begin->hit, begin->normal, begin->view, 1);
    const int column = int(begin->pixel) % camera_.width, row = int(begin->pixel) / camera_.width;
    for (int j = 0; j < kRaster; ++j)
      for (int i = 0; i < kRaster; ++i) addPart(column, row, i, j);
    merge();
  }
  /// Of the last look; nodes in order.
  const std::vector<View::Share>& shares() const { return shares_; }
  const std::vector<View::Spot>& spots() const { return spots_; }

 private:
  static constexpr float kSteep = 0.45f;  // cosine to the eye
  static constexpr int kRaster = 4;       // parts of a pixel each way, one look at the light each
  static constexpr int kCoverage = 2;     // rays of a part each way, that tell how much of it is covered

  /// Whether one look at its middle tells a pixel.
  bool isPlain(const Receiver& receiver) const {
    const auto& body = world_.bodies[size_t(receiver.hit.object)];
    return receiver.weight == 1 && glm::dot(receiver.normal, receiver.view) > kSteep &&
           (!body || receiver.depth * pixel_ < float(body->shape->grid.side()) * body->size);
  }

  /// Part (i, j) of a pixel, weighted by its share.
  void addPart(int column, int row, int i, int j) {
    constexpr int kSide = kRaster * kCoverage, kRays = kCoverage * kCoverage;
    RayHit middle;
    glm::vec3 view(0);
    int hits = 0;
    for (int n = 0; n < kRays; ++n) {
      const double x = (i * kCoverage + n % kCoverage + 0.5) / kSide;
      const double y = (j * kCoverage + n / kCoverage + 0.5) / kSide;
      const glm::vec3 direction(camera_.direction(column + x, row + y));
      const RayHit hit = rays_.nearest(glm::vec3(camera_.position), direction);
      if (!hit) continue;
      // One of them stands for all, another one in each part, so that no side is preferred.
      if (hits == 0 || n == (i + 2 * j) % kRays) middle = hit, view = -direction;
      ++hits;
    }
    if (hits == 0) return;
    glm::vec3 normal = rays_.mesh(middle.object).shadingNormal(middle);
    if (glm::dot(normal, view) < 1e-3f) normal = middle.normal;
    add(middle, normal, view, float(hits) / (kSide * kSide));
  }

  void add(const RayHit& hit, const glm::vec3& normal, const glm::vec3& view, float weight) {
    if (rays_.opaque(hit.object)) return;
    const auto object = size_t(hit.object);
    const Body& body = *world_.bodies[object];
    const Surface& surface = body.shape->surface;
    const uint32_t cell = surface.samples()[surface.sampleAt(hit.triangle, hit.u, hit.v)].cell;
    Gather::weigh(*body.shape, body.toLocal(hit.position), body.turnBack * normal, cell, weights_);
    const double cosO = glm::clamp(double(glm::dot(normal, view)), 0.0, 1.0);
    const auto lobe = float(exitLobe(cosO, double(body.medium.eta)));
    spots_.push_back(
        {onSmoothSurface(rays_.mesh(hit.object), hit, normal), uint32_t(object), weight, weight * lobe});
    for (const Gather::Weight& w : weights_)
      shares_.push_back({firstNode_[object] + w.node, weight * w.weight, weight * w.weight * lobe});
  }

  /// One share a node.
  void merge() {
    std::sort(shares_.begin(), shares_.end(),
              [](const View::Share& a, const View::Share& b) { return a.node < b.node; });
    size_t to = 0;
    for (size_t i = 0; i < shares_.size(); ++i)
      if (to > 0 && shares_[to - 1].node == shares_[i].node) {
        shares_[to - 1].radiosity += shares_[i].radiosity;
        shares_[to - 1].radiance += shares_[i].radiance;
      } else {
        shares_[to++] = shares_[i];
      }
    shares_.resize(to);
  }

  const RayScene& rays_;
  const World& world_;
  const CameraFrame& camera_;
  const float pixel_;  ///< its side at a depth of 1
  const std::vector<uint32_t>& firstNode_;
  std::vector<Gather::Weight> weights_;
  std::vector<View::Share> shares_;
  std::vector<View::Spot> spots_;
};

std::vector<float> etasOf(const World& world) {
  std::vector<float> etas;
  for (const auto& body : world.bodies) etas.push_back(body ? body->medium.eta : 0);
  return etas;
}

bool near(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::distance(a, b) <= kSameCamera * (1 + glm::length(a));
}

}  // namespace

View::View(const RayScene& rays, const World& world, int width, int height)
    : rays_(rays),
      world_(world),
      camera_(rays.camera(width, height)),
      etas_(etasOf(world)),
      receivers_(findReceivers(rays, width, height)) {
  uint32_t nodes = 0;
  for (const auto& body : world.bodies) {
    firstNode_.push_back(nodes);
    if (body) nodes += uint32_t(body->shape->surface.nodes().size());
  }
  const std::vector<Receiver>& all = receivers_.receivers;  // those of a pixel follow each other
  nearest_.assign(world.bodies.size(), std::numeric_limits<float>::infinity());
  for (const Receiver& receiver : all) {
    float& nearest = nearest_[size_t(receiver.hit.object)];
    nearest = std::fmin(nearest, receiver.depth);
  }
  for (size_t i = 0; i < all.size(); ++i)
    if (i == 0 || all[i].pixel != all[i - 1].pixel) first_.push_back(i);
  blocks_.resize((first_.size() + kBlock - 1) / kBlock);
  first_.push_back(all.size());
}

bool View::isOf(const RayScene& rays, const World& world, int width, int height) const {
  const CameraFrame now = rays.camera(width, height);
  return &rays == &rays_ && &world == &world_ && width == camera_.width && height == camera_.height &&
         near(now.position, camera_.position) && near(now.right, camera_.right) && near(now.up, camera_.up) &&
         near(now.forward, camera_.forward) &&
         std::abs(now.tanHalfFovX - camera_.tanHalfFovX) <= kSameCamera &&
         std::abs(now.tanHalfFovY - camera_.tanHalfFovY) <= kSameCamera && etasOf(world) == etas_;
}

View::Block View::make(size_t block) const {
  const std::vector<Receiver>& all = receivers_.receivers;
  Block result;
  Looker looker(rays_, world_, camera_, firstNode_);
  for (size_t p = block * kBlock; p < std::min(first_.size() - 1, (block + 1) * kBlock); ++p) {
    looker.look(all.data() + first_[p], all.data() + first_[p + 1]);
    result.shares.insert(result.shares.end(), looker.shares().begin(), looker.shares().end());
    result.spots.insert(result.spots.end(), looker.spots().begin(), looker.spots().end());
    result.last.push_back(uint32_t(result.shares.size()));
    result.lastSpot.push_back(uint32_t(result.spots.size()));
  }
  result.shares.shrink_to_fit();
  result.spots.shrink_to_fit();
  return result;
}

size_t View::Block::memoryBytes() const {
  return shares.size() * sizeof(Share) + spots.size() * sizeof(Spot) + 2 * last.size() * sizeof(uint32_t);
}

void View::forPixels(const std::function<void(const Pixel&)>& visit) {
  tbb::parallel_for(size_t(0), blocks_.size(), [&](size_t b) {
    Interruptible::check();
    Block made;
    if (blocks_[b].last.empty()) made = make(b);
    visitBlock(b, made.last.empty() ? blocks_[b] : made, visit);
    const size_t bytes = made.memoryBytes();
    if (made.last.empty() || kept_ + bytes > kMostBytes) return;
    kept_ += bytes;
    blocks_[b] = std::move(made);
  });
  complete_ = true;
}

const SingleLight& View::singleLight() {
  if (singleLight_)
    singleLight_->updateMedia();
  else
    singleLight_ = std::make_unique<SingleLight>(rays_, receivers_);
  return *singleLight_;
}

size_t View::memoryBytes() const {
  return kept_ + receivers_.receivers.capacity() * sizeof(Receiver) +
         (singleLight_ ? singleLight_->memoryBytes() : 0);
}

}  // namespace lychnite::volume
