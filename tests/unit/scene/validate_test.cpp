#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "lychnite/base/error.h"
#include "unit/scene/scenes.h"

namespace lychnite {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Case {
  std::string where;  ///< what the message must begin with
  std::function<void(Scene&)> spoil;
};

Scene wholeScene() {
  Scene scene = oneObject("sphere", 20);
  scene.lights.push_back(PointLight{.position = {0, 0, 100}, .intensity = Rgb(1e4)});
  return scene;
}

Material& material(Scene& scene) {
  return scene.objects[0].material;
}
ParallelLight& parallel(Scene& scene) {
  return std::get<ParallelLight>(scene.lights[0]);
}
PointLight& point(Scene& scene) {
  return std::get<PointLight>(scene.lights[1]);
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"scene", [](Scene& s) { s.objects.clear(); }},
      {"scene", [](Scene& s) { s.objects.resize(251, s.objects[0]); }},
      {"scene", [](Scene& s) { s.lights.resize(65, s.lights[0]); }},
      {"object 'sphere'", [](Scene& s) { s.objects[0].mesh = nullptr; }},
      {"object 'sphere'", [](Scene& s) { s.objects[0].mesh = std::make_shared<Mesh>(); }},
      {"object 'bust' size", [](Scene& s) { s.objects[0].name = "bust", s.objects[0].size = 0; }},
      {"object 1 size", [](Scene& s) { s.objects[0].model = "", s.objects[0].size = -1; }},
      {"object 'sphere' size", [](Scene& s) { s.objects[0].size = kNan; }},
      {"object 'sphere' size", [](Scene& s) { s.objects[0].size = kInfinity; }},
      {"object 'sphere' size (mm)", [](Scene& s) { s.objects[0].size = 1e-7; }},
      {"object 'sphere' size (mm)", [](Scene& s) { s.objects[0].size = 1e10; }},
      {"object 'sphere' position", [](Scene& s) { s.objects[0].position.y = kNan; }},
      {"object 'sphere' rotation", [](Scene& s) { s.objects[0].rotation = glm::dquat(2, 0, 0, 0); }},
      {"object 'sphere' rotation", [](Scene& s) { s.objects[0].rotation = glm::dquat(kNan, 0, 0, 0); }},
      {"object 'sphere' material: sigma_s", [](Scene& s) { material(s).medium.sigma_s.x = -1; }},
      {"object 'sphere' material: sigma_a", [](Scene& s) { material(s).medium.sigma_a.z = kNan; }},
      {"object 'sphere' material: g", [](Scene& s) { material(s).medium.g = 1; }},
      {"object 'sphere' material: eta", [](Scene& s) { material(s).medium.eta = 0.7; }},
      {"object 'sphere' roughness", [](Scene& s) { material(s).roughness = 0.019; }},
      {"object 'sphere' roughness", [](Scene& s) { material(s).roughness = 1.01; }},
      {"object 'sphere' colour", [](Scene& s) { material(s).colour.y = 1.5; }},
      {"object 'sphere' colour", [](Scene& s) { material(s).colour.y = -0.5; }},
      {"light 1 angles", [](Scene& s) { parallel(s).azimuth = kNan; }},
      {"light 1 angles", [](Scene& s) { parallel(s).elevation = kInfinity; }},
      {"light 1 irradiance", [](Scene& s) { parallel(s).irradiance.y = -1; }},
      {"light 2 position", [](Scene& s) { point(s).position.x = kInfinity; }},
      {"light 2 intensity", [](Scene& s) { point(s).intensity.z = kNan; }},
      {"camera angles", [](Scene& s) { s.camera = OrbitCamera{.azimuth = kNan}; }},
      {"camera factor", [](Scene& s) { s.camera = OrbitCamera{.factor = 0}; }},
      {"camera fov", [](Scene& s) { s.camera = OrbitCamera{.fov = 0}; }},
      {"camera fov", [](Scene& s) { s.camera = OrbitCamera{.fov = 171}; }},
      {"camera position",
       [](Scene& s) {
         s.camera = PinholeCamera{.position = {kNan, 0, 0}};
       }},
      {"camera target",
       [](Scene& s) {
         s.camera = PinholeCamera{.target = {0, kInfinity, 0}};
       }},
      {"camera up",
       [](Scene& s) {
         s.camera = PinholeCamera{.up = {0, kNan, 0}};
       }},
      {"camera up",
       [](Scene& s) {
         s.camera = PinholeCamera{.up = {0, 0, 0}};
       }},
      {"camera fov", [](Scene& s) { s.camera = PinholeCamera{.fov = 180}; }},
      {"camera",
       [](Scene& s) {
         s.camera = PinholeCamera{.position = {1, 2, 3}, .target = {1, 2, 3}};
       }},
      {"background", [](Scene& s) { s.background.x = -0.1; }},
      {"ambient", [](Scene& s) { s.ambient.z = kInfinity; }},
  };
  return all;
}

TEST(ValidateScene, TakesAWholeOne) {
  EXPECT_NO_THROW(validate(wholeScene()));
  Scene dark = wholeScene();
  dark.lights.clear();
  EXPECT_NO_THROW(validate(dark)) << "darkness is a picture too";
}

TEST(ValidateScene, NamesWhatCannotBeRendered) {
  for (size_t i = 0; i < cases().size(); ++i) {
    Scene scene = wholeScene();
    cases()[i].spoil(scene);
    try {
      validate(scene);
      ADD_FAILURE() << "case " << i << " (" << cases()[i].where << ") was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.parts().where.rfind(cases()[i].where, 0), 0u) << "case " << i << ": " << error.what();
      EXPECT_FALSE(error.parts().expected.empty()) << error.what();
      EXPECT_FALSE(error.parts().found.empty()) << error.what();
      EXPECT_EQ(error.kind(), Error::Kind::kUsage);
    }
  }
}

}  // namespace
}  // namespace lychnite
