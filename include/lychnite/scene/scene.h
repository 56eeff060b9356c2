#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "lychnite/mesh/animation.h"
#include "lychnite/mesh/mesh.h"
#include "lychnite/optics/coefficients.h"

namespace lychnite {

/// What an object is made of. Translucent: the medium scatters inside, the surface is a dielectric coat over
/// it. Opaque: a Lambertian base of `colour` under the same coat.
struct Material {
  std::string name = "marble";  ///< for metadata; "custom" when the coefficients are the user's
  Coefficients medium;          ///< also gives eta to an opaque object's coat
  double roughness = 0.3;       ///< GGX alpha = roughness^2, in [0.02, 1]
  bool opaque = false;
  Rgb colour{0.5};  ///< diffuse albedo of an opaque object, in [0, 1]
};

/// A mesh at its true size. The mesh's bounding-box centre goes to `position`; its longest side (before
/// rotation) becomes `size`.
struct Object {
  std::string name;   ///< for messages, "" is fine
  std::string model;  ///< where the mesh came from: a path or a built-in's name (written to scene files)
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const MeshAnimation> animation;  ///< what can move in the model's file; null: nothing
  std::string clip;                                ///< that `mesh` shows a moment of, see setPose(); "": rest
  double time = 0;                                 ///< of the moment, s
  Material material;
  double size = 20;        ///< mm, > 0
  glm::dvec3 position{0};  ///< mm
  glm::dquat rotation{1, 0, 0, 0};
};

/// Shows a moment of one of the object's clips, or the mesh at rest for "". Its size and place are those of
/// the mesh at rest. Throws Error for a pose that MeshAnimation::pose() refuses, and (Kind::kUsage) for a
/// clip that the model does not have, naming the nearest; the object is then as it was.
void setPose(Object& object, const std::string& clip, double seconds);

/// Light from infinitely far. `irradiance` is E0 on a surface facing it; pi makes white Lambertian
/// radiance 1.
struct ParallelLight {
  double azimuth = -40,
         elevation = 35;  ///< degrees, of the direction *towards* the light; see directionFromAngles
  Rgb irradiance{3.14159265358979323846};
};

/// Isotropic point: irradiance intensity / distance^2 on a surface facing it, distance in mm.
struct PointLight {
  glm::dvec3 position{0};  ///< mm
  Rgb intensity{1};        ///< irradiance times mm^2
};

using Light = std::variant<ParallelLight, PointLight>;

/// Turns about the scene's centre at a distance that frames the scene's objects: `factor` 1 makes the
/// bounding sphere of all translucent objects (of all objects when none is) touch the picture's edge; 2 is
/// twice as far.
struct OrbitCamera {
  double azimuth = 0, elevation = 10;  ///< degrees, of the direction towards the camera
  double factor = 1.0;                 ///< > 0
  double fov = 30;                     ///< vertical, degrees, in (0, 170)
};

struct PinholeCamera {
  glm::dvec3 position{0, 0, 100}, target{0};  ///< mm
  glm::dvec3 up{0, 1, 0};
  double fov = 30;  ///< vertical, degrees
};

using Camera = std::variant<OrbitCamera, PinholeCamera>;

/// Everything that is rendered. Plain data: copy it, change it, render it again. Meshes are shared and
/// immutable; a deforming object gets a new mesh.
struct Scene {
  std::vector<Object> objects;
  std::vector<Light> lights;
  Camera camera = OrbitCamera{};
  Rgb background{0};  ///< radiance
  Rgb ambient{
      0};  ///< radiance of a uniform, unoccluded surrounding; seen by surfaces only, not by the camera
};

/// Unit vector for azimuth and elevation in degrees, y up: azimuth 0 is +z (towards the default camera), 90
/// is +x, 180 is -z (behind the object).
glm::dvec3 directionFromAngles(double azimuth, double elevation);

/// Throws Error for whatever cannot be rendered: no object, no mesh, size not positive and finite, bad
/// coefficients, bad roughness, colours, lights or cameras, naming the object or light.
void validate(const Scene& scene);

/// Where a mesh vertex p lies in the world: position + scale * rotation * (p - centre), in mm.
struct Placement {
  glm::dvec3 centre{0};  ///< of the mesh's bounding box, mesh units
  double scale = 1;      ///< mm per mesh unit
  glm::dquat rotation{1, 0, 0, 0};
  glm::dvec3 position{0};  ///< mm
  glm::dvec3 point(const glm::dvec3& p) const { return position + rotation * ((p - centre) * scale); }
  glm::dvec3 direction(const glm::dvec3& d) const { return rotation * d; }
};
Placement placementOf(const Object& object);

struct Sphere {
  glm::dvec3 centre{0};
  double radius = 0;
};
/// Bounding sphere in mm (centre = middle of the bounding box of the placed vertices' sphere; not minimal).
Sphere boundingSphere(const Object& object);
/// Of all objects, or of the translucent ones only.
Sphere boundingSphere(const Scene& scene, bool translucentOnly = false);

/// The camera as numbers, the same for every method: a ray through picture position (x, y) in pixels, (0, 0)
/// the upper left corner, starts at `position` and goes along direction(x, y).
struct CameraFrame {
  glm::dvec3 position{0};                                     ///< mm
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  ///< orthonormal
  double tanHalfFovX = 1, tanHalfFovY = 1;
  int width = 1, height = 1;
  /// Unit direction.
  glm::dvec3 direction(double x, double y) const;
  /// Picture position in pixels and distance along `forward` of a point.
  glm::dvec3 project(const glm::dvec3& point) const;
};
CameraFrame cameraFrame(const Scene& scene, int width, int height);

}  // namespace lychnite
