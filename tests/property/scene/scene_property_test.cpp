#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "lychnite/scene/scene_file.h"
#include "property/random.h"
#include "scratch.h"
#include "unit/scene/scenes.h"

namespace lychnite {
namespace {

Camera randomCamera(Random& random) {
  if (random.coin())
    return OrbitCamera{.azimuth = random.uniform(-200, 200),
                       .elevation = random.uniform(-90, 90),
                       .factor = random.logUniform(0.1, 10),
                       .fov = random.uniform(1, 160)};
  return PinholeCamera{.position = random.rgb(50, 100),
                       .target = random.rgb(-20, 20),
                       .up = random.direction(),
                       .fov = random.uniform(1, 160)};
}

Scene randomScene(Random& random) {
  Scene scene;
  const char* models[]{"sphere", "slab", "disc", "stone"};
  for (int i = 0; i < 3; ++i) {
    Object object = makeObject(models[int(random.uniform(0, 4))], random.logUniform(1e-3, 1e5));
    object.position = random.rgb(-30, 30);
    object.rotation = glm::angleAxis(random.uniform(-3, 3), random.direction());
    if (random.coin()) {
      object.material.name = "custom";
      object.material.medium = random.medium();
    }
    object.material.roughness = random.uniform(0.02, 1);
    object.material.opaque = random.coin();
    if (object.material.opaque) object.material.colour = random.rgb(0, 1);
    scene.objects.push_back(object);
  }
  scene.lights.push_back(ParallelLight{.azimuth = random.uniform(-180, 180),
                                       .elevation = random.uniform(-90, 90),
                                       .irradiance = random.logRgb(1e-3, 1e3)});
  scene.lights.push_back(
      PointLight{.position = random.rgb(-1e3, 1e3), .intensity = random.logRgb(1e-6, 1e9)});
  scene.camera = randomCamera(random);
  scene.background = random.rgb(0, 2);
  scene.ambient = random.logRgb(1e-9, 1);
  return scene;
}

TEST(SceneProperties, FilesGiveBackWhatWasWritten) {
  Random random(1);
  const ScratchFolder folder;
  for (int i = 0; i < 60; ++i) {
    const Scene scene = randomScene(random);
    ASSERT_NO_THROW(validate(scene));
    writeScene(scene, folder / "s.toml");
    const Scene back = readScene(folder / "s.toml");
    ASSERT_EQ(sceneToToml(back), sceneToToml(scene));
    for (size_t o = 0; o < scene.objects.size(); ++o) {
      ASSERT_EQ(back.objects[o].size, scene.objects[o].size);
      ASSERT_EQ(back.objects[o].position, scene.objects[o].position);
      ASSERT_TRUE(back.objects[o].rotation == scene.objects[o].rotation);
      ASSERT_EQ(back.objects[o].material.medium, scene.objects[o].material.medium);
    }
  }
}

TEST(SceneProperties, CamerasProjectTheirOwnRays) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const Scene scene = randomScene(random);
    const CameraFrame frame =
        cameraFrame(scene, 1 + int(random.uniform(0, 2000)), 1 + int(random.uniform(0, 2000)));
    const double x = random.uniform(0, frame.width), y = random.uniform(0, frame.height);
    const double far = random.logUniform(1e-2, 1e4);
    const glm::dvec3 there = frame.project(frame.position + far * frame.direction(x, y));
    // What is lost is the position's last digits over the distance.
    const double slack =
        1e-9 * (1 + glm::length(frame.position) / far) * (frame.width + frame.height) / frame.tanHalfFovY;
    EXPECT_NEAR(there.x, x, slack);
    EXPECT_NEAR(there.y, y, slack);
  }
}

TEST(SceneProperties, OrbitsKeepTheSphereInThePicture) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Scene scene = randomScene(random);
    scene.camera = OrbitCamera{.azimuth = random.uniform(-180, 180),
                               .elevation = random.uniform(-90, 90),
                               .factor = 1,
                               .fov = random.uniform(5, 120)};
    Sphere subject = boundingSphere(scene, true);
    if (subject.radius == 0) subject = boundingSphere(scene);
    const CameraFrame frame = cameraFrame(scene, 100, 60 + 10 * (i % 9));
    for (int k = 0; k < 20; ++k) {
      const glm::dvec3 p = frame.project(subject.centre + subject.radius * random.direction());
      EXPECT_GE(std::min(p.x, p.y), -1e-6);
      EXPECT_LE(p.x, frame.width + 1e-6);
      EXPECT_LE(p.y, frame.height + 1e-6);
    }
  }
}

}  // namespace
}  // namespace lychnite
