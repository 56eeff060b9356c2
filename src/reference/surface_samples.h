#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "reference/dipole_kernel.h"
#include "reference/ray_scene.h"

namespace lychnite {

/// A point of an object's surface. Scene units.
struct SurfacePoint {
  glm::vec3 position{0};
  glm::vec3 normal{0, 0, 1};  ///< unit, outwards
};

/// Area-uniform, evenly spread points on an object's true surface.
///
/// The surface is laid along one curve that keeps area and nearness: triangles in Hilbert order of their
/// centroids (Skilling 2004), each filled by a Sierpinski curve. Cutting the curve into n equal lengths gives
/// n compact patches of equal area; one random point in each is an unbiased sample whose error falls faster
/// than that of free points.
class SurfaceSampler {
 public:
  explicit SurfaceSampler(const RayMesh& mesh);

  double area() const { return cumulative_.back(); }  ///< unit^2
  /// Side of a square as large as one of n patches.
  double spacing(size_t n) const;
  /// Which of n patches a point lies in.
  size_t patchOf(const MeshPoint& point, size_t n) const;
  /// `each` random points in each of n patches, patch after patch; the same for the same seed.
  std::vector<MeshPoint> pointsOfPatches(size_t n, size_t each, uint64_t seed) const;
  /// n points, each standing for area() / n; the same for the same seed whatever the thread count.
  std::vector<SurfacePoint> sample(size_t n, uint64_t seed) const;

 private:
  MeshPoint at(double areaBefore) const;

  const RayMesh& mesh_;
  std::vector<uint32_t> order_;     ///< triangles along the curve
  std::vector<uint32_t> place_;     ///< of each triangle in it
  std::vector<double> cumulative_;  ///< area up to and with order_[i]
};

/// A uniform number in [0, 1) for each pair: SplitMix64 (Steele et al. 2014) of the index in the seed's
/// stream.
double uniformAt(uint64_t seed, uint64_t index);

/// What enters per area at a point of the surface: the sum over the lights of Ft E cos, 0 where shadowed.
/// `light` picks one of the scene's lights, -1 takes all.
Rgb enteringIrradiance(const RayScene& scene, double eta, const SurfacePoint& point, int light);

/// Samples of an object with the flux that enters through them, dark ones left out, in the order of the
/// curve.
FluxPoints litSamples(const RayScene& scene, int object, const SurfaceSampler& sampler, size_t n,
                      uint64_t seed, int light);

}  // namespace lychnite
