#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "lychnite/scene/scene.h"

namespace lychnite {

/// Where a ray meets a surface. Scene units (RayScene).
struct RayHit {
  int object = -1;  ///< index into Scene::objects; -1 for none
  uint32_t triangle = 0;
  float distance = std::numeric_limits<float>::infinity();
  glm::vec3 position{0};  ///< from the triangle's corners, not from the ray
  glm::vec3 normal{0};    ///< geometric, unit, out of the mesh (counter-clockwise triangles)
  float u = 0, v = 0;     ///< barycentric weights of the second and third corner
  explicit operator bool() const { return object >= 0; }
};

/// A light in scene units. `power` is the irradiance E0 of a parallel light, the intensity I (irradiance
/// times unit^2) of a point light.
struct RayLight {
  bool parallel = true;
  glm::dvec3 direction{0, 0, 1};  ///< unit, towards a parallel light
  glm::dvec3 position{0};         ///< of a point light
  Rgb power{0};

  /// Seen from a point: unit direction towards the light, distance (infinite for parallel), and the
  /// irradiance on a surface facing it (inverse square included).
  struct Seen {
    glm::dvec3 direction;
    double distance;
    Rgb irradiance;
  };
  Seen seenFrom(const glm::dvec3& point) const;
};

/// A placed mesh in scene units.
struct RayMesh {
  std::vector<glm::vec3> positions, normals;
  const std::vector<glm::uvec3>* triangles = nullptr;  ///< the mesh's own
  std::vector<glm::vec3> facets;                       ///< unit geometric normal of each triangle

  /// Interpolated unit normal at a hit.
  glm::vec3 shadingNormal(const RayHit& hit) const;
};

/// The scene as rays see it: Embree over all placed meshes, in *scene units*: lengths divided by the radius
/// of the translucent objects' bounding sphere (of all objects when none is translucent), its centre at the
/// origin. So a scene scaled by s with coefficients over s is the same numbers. All queries may be called
/// from several threads.
class RayScene {
 public:
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Takes on another scene whose shapes are the same numbers in scene units: only lights, materials, the
  /// camera or the size of everything differ. False, and nothing is changed, when they are not.
  bool adopt(const Scene& scene);

  const Scene& scene() const { return scene_; }
  double unit() const { return unit_; }          ///< mm per scene unit
  glm::dvec3 origin() const { return origin_; }  ///< mm
  glm::dvec3 toUnits(const glm::dvec3& mm) const { return (mm - origin_) / unit_; }

  size_t objectCount() const { return meshes_.size(); }
  const RayMesh& mesh(int object) const { return meshes_[size_t(object)]; }
  bool opaque(int object) const { return scene_.objects[size_t(object)].material.opaque; }
  /// The object's medium with coefficients per scene unit.
  Coefficients medium(int object) const {
    return scene_.objects[size_t(object)].material.medium.scaled(1.0 / unit_);
  }
  const std::vector<RayLight>& lights() const { return lights_; }
  /// Position in scene units; directions and angles as ever.
  CameraFrame camera(int width, int height) const;

  /// Distance by which an origin is moved off a surface so that a ray from it does not meet that surface
  /// again.
  static constexpr float kOffset = 4e-6f;

  /// Nearest surface of any object along unit `direction`, up to `maxDistance`.
  RayHit nearest(const glm::vec3& from, const glm::vec3& direction,
                 float maxDistance = std::numeric_limits<float>::infinity()) const;
  /// Nearest surface that light inside `object` can meet: its own or an opaque object's; other translucent
  /// objects that overlap it are not there.
  RayHit nearestInside(int object, const glm::vec3& from, const glm::vec3& direction,
                       float maxDistance = std::numeric_limits<float>::infinity()) const;
  /// Whether anything lies between `from` and `maxDistance` along unit `direction`.
  bool occluded(const glm::vec3& from, const glm::vec3& direction,
                float maxDistance = std::numeric_limits<float>::infinity()) const;

  /// Whether a point is inside a closed object (one ray: the first surface of the object met from behind).
  bool inside(int object, const glm::vec3& point) const;

  /// For packet queries of the walk: the RTCScene of nearest() or nearestInside(), as an opaque pointer.
  void* embreeScene() const;
  void* embreeSceneInside(int object) const;
  /// Makes a hit of Embree's ids and barycentrics.
  RayHit hitOf(int object, uint32_t triangle, float u, float v, float distance) const;

 private:
  struct Impl;
  Scene scene_;
  double unit_ = 1;
  glm::dvec3 origin_{0};
  std::vector<RayMesh> meshes_;
  std::vector<RayLight> lights_;
  std::unique_ptr<Impl> impl_;
};

/// `hit.position` moved off the surface to the side `direction` points to.
glm::vec3 offPoint(const RayHit& hit, const glm::vec3& direction);

}  // namespace lychnite
