#include "lychnite/scene/scene_file.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "lychnite/base/error.h"
#include "scratch.h"
#include "unit/scene/scenes.h"

namespace lychnite {
namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Scene fromText(const std::string& text) {
  const ScratchFolder folder;
  write(folder / "s.toml", text);
  return readScene(folder / "s.toml");
}

void expectEqual(const Material& a, const Material& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.medium, b.medium);
  EXPECT_EQ(a.roughness, b.roughness);
  EXPECT_EQ(a.opaque, b.opaque);
  if (!a.opaque) return;  // nothing but opaque objects has a colour of its own
  EXPECT_EQ(a.colour, b.colour);
}

void expectEqual(const Object& a, const Object& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.mesh, b.mesh) << "built-in meshes are shared";
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.position, b.position);
  EXPECT_TRUE(a.rotation == b.rotation);
  expectEqual(a.material, b.material);
}

void expectEqual(const Light& a, const Light& b) {
  ASSERT_EQ(a.index(), b.index());
  if (const auto* one = std::get_if<ParallelLight>(&a)) {
    const auto& other = std::get<ParallelLight>(b);
    EXPECT_EQ(one->azimuth, other.azimuth);
    EXPECT_EQ(one->elevation, other.elevation);
    EXPECT_EQ(one->irradiance, other.irradiance);
  } else {
    EXPECT_EQ(std::get<PointLight>(a).position, std::get<PointLight>(b).position);
    EXPECT_EQ(std::get<PointLight>(a).intensity, std::get<PointLight>(b).intensity);
  }
}

void expectEqual(const Camera& a, const Camera& b) {
  ASSERT_EQ(a.index(), b.index());
  if (const auto* one = std::get_if<OrbitCamera>(&a)) {
    const auto& other = std::get<OrbitCamera>(b);
    EXPECT_EQ(one->azimuth, other.azimuth);
    EXPECT_EQ(one->elevation, other.elevation);
    EXPECT_EQ(one->factor, other.factor);
    EXPECT_EQ(one->fov, other.fov);
  } else {
    const auto &pinhole = std::get<PinholeCamera>(a), &other = std::get<PinholeCamera>(b);
    EXPECT_EQ(pinhole.position, other.position);
    EXPECT_EQ(pinhole.target, other.target);
    EXPECT_EQ(pinhole.up, other.up);
    EXPECT_EQ(pinhole.fov, other.fov);
  }
}

/// Every field away from its default, with digits that do not survive a careless format.
Scene elaborateScene() {
  Scene scene;
  scene.background = {0.1, 0.2 + 1e-16, 1.0 / 3};
  scene.ambient = {1e-9, 0.25, 12345.678901234567};
  scene.objects.push_back(makeObject("sphere", 20.0 / 3, "skin1"));
  scene.objects[0].name = "the \"left\" \\ one";
  scene.objects[0].position = {1.0 / 7, -2e-5, 3e6};
  scene.objects[0].rotation = glm::normalize(glm::dquat(0.9, 0.1, -0.2, 0.3));
  scene.objects[0].material.roughness = 0.1 + 0.2;
  scene.objects.push_back(makeObject("slab", 400));
  scene.objects[1].material = {
      .name = "custom",
      .medium = {.sigma_s = {1.1, 2.2, 1.0 / 3}, .sigma_a = {0, 1e-4, 5}, .g = -0.3, .eta = 1.45},
      .roughness = 0.7,
      .opaque = true,
      .colour = {0.1, 0.9, 1.0 / 3}};
  scene.lights.push_back(ParallelLight{.azimuth = 12.5, .elevation = -80, .irradiance = {1, 2, 3}});
  scene.lights.push_back(PointLight{.position = {0.1, 200, -1.0 / 3}, .intensity = {1e5, 2e-5, 0}});
  scene.camera = OrbitCamera{.azimuth = -33.3, .elevation = 7, .factor = 1.25, .fov = 41};
  return scene;
}

TEST(SceneFile, RoundTripKeepsEveryField) {
  Scene scene = elaborateScene();
  for (const Camera& camera :
       {scene.camera,
        Camera(PinholeCamera{
            .position = {1, 2, 1.0 / 3}, .target = {-1, 0.1, 5}, .up = {0.1, 1, 0}, .fov = 55})}) {
    scene.camera = camera;
    const ScratchFolder folder;
    writeScene(scene, folder / "s.toml");
    const Scene back = readScene(folder / "s.toml");
    EXPECT_EQ(back.background, scene.background);
    EXPECT_EQ(back.ambient, scene.ambient);
    ASSERT_EQ(back.objects.size(), 2u);
    for (size_t i = 0; i < 2; ++i) expectEqual(back.objects[i], scene.objects[i]);
    ASSERT_EQ(back.lights.size(), 2u);
    for (size_t i = 0; i < 2; ++i) expectEqual(back.lights[i], scene.lights[i]);
    expectEqual(back.camera, scene.camera);
    EXPECT_EQ(sceneToToml(back), sceneToToml(scene));
  }
}

TEST(SceneFile, TheLeastThatWorks) {
  const Scene scene = fromText("[[object]]\nmodel = \"sphere\"\nsize = \"3cm\"\n");
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].size, 30);
  EXPECT_EQ(scene.objects[0].material.name, "marble");
  EXPECT_EQ(scene.objects[0].mesh, builtinMesh("sphere"));
  EXPECT_TRUE(std::holds_alternative<OrbitCamera>(scene.camera));
}

TEST(SceneFile, TakesOneNumberForThreeAndNamedMaterialsWithChanges) {
  const Scene scene = fromText(
      "ambient = 0.5\n[[object]]\nmodel = \"sphere\"\nsize = \"1in\"\nrotation = [0, 90, 0]\n"
      "material = {name = \"marble\", roughness = 0.1, sigma_a = 2}\n"
      "[[object]]\nmodel = \"slab\"\nsize = \"1m\"\nmaterial = {opaque = true, colour = [1, 0, 0]}\n");
  EXPECT_EQ(scene.ambient, Rgb(0.5));
  EXPECT_DOUBLE_EQ(scene.objects[0].size, 25.4);
  const Material& changed = scene.objects[0].material;
  EXPECT_EQ(changed.name, "custom") << "no longer the library's";
  EXPECT_EQ(changed.medium.sigma_a, Rgb(2));
  EXPECT_EQ(changed.medium.sigma_s, findMaterial("marble", "").coefficients.sigma_s);
  EXPECT_EQ(changed.roughness, 0.1);
  EXPECT_NEAR(scene.objects[0].rotation.w, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(scene.objects[0].rotation.y, std::sqrt(0.5), 1e-12);
  EXPECT_TRUE(scene.objects[1].material.opaque);
  EXPECT_EQ(scene.objects[1].material.colour, Rgb(1, 0, 0));
}

TEST(SceneFile, MeshFilesAreFoundBesideTheScene) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "models");
  write(folder / "models/t.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
  write(folder / "s.toml", "[[object]]\nmodel = \"models/t.obj\"\nsize = \"5mm\"\n");
  const Scene scene = readScene(folder / "s.toml");
  EXPECT_EQ(scene.objects[0].mesh->triangles.size(), 1u);
  EXPECT_EQ(scene.objects[0].model, "models/t.obj");
}

struct Mistake {
  const char* text;
  const char* where;    ///< after the path
  const char* mention;  ///< somewhere in the message
};

TEST(SceneFile, MistakesNameFileLineAndKey) {
  const Mistake mistakes[]{
      {"[[object]]\nmodel = \"sphere\"\nsise = \"2cm\"\n", ":3: sise", "'size'"},
      {"[[object]]\nmodel = \"sphere\"\nsize = 20\n", ":3: size", "unit"},
      {"[[object]]\nmodel = \"sphere\"\nsize = \"20\"\n", ":3: size", "20mm"},
      {"[[object]]\nmodel = \"sphere\"\nsize = \"-2cm\"\n", ":3: size", "above zero"},
      {"[[object]]\nmodel = \"sphere\"\n", ":1: size", "true size"},
      {"[[object]]\nsize = \"2cm\"\n", ":1: model", "text"},
      {"[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\nmaterial = \"marbel\"\n", ":4: material", "'marble'"},
      {"[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\nposition = [0, 0, 0]\n", ":4: position", "lengths"},
      {"[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\nquaternion = [1, 0, 0]\n", ":4: quaternion",
       "w, x, y, z"},
      {"[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\nquaternion = [0.0, 0.0, 0.0, 0.0]\n",
       ":4: quaternion", "all 0"},
      {"[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\nmaterial = {sigma_s = -1}\n", ":4: sigma_s", "0/mm"},
      {"[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\nmaterial = {g = 0.5}\n", ":4: sigma_s", "sigma_a"},
      {"[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\nmaterial = {opaque = 1}\n", ":4: opaque",
       "true or false"},
      {"background = [1, 2]\n[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\n", ":1: background",
       "three numbers"},
      {"background = [1, 2, nan]\n[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\n", ":1: background",
       "finite"},
      {"[camera]\ntype = \"fisheye\"\n[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\n", ":2: type", "orbit"},
      {"[camera]\nfovy = 30\n[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\n", ":2: fovy", "'fov'"},
      {"[[light]]\ntype = \"spot\"\n[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\n", ":2: type",
       "parallel"},
      {"[[light]]\ntype = \"point\"\n[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\n", ":1: position",
       "lengths"},
      {"[light]\ntype = \"point\"\n[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\n", ":1: light",
       "[[light]]"},
      {"background = 1\n", "object", "[[object]]"},
      {"lights = 1\n[[object]]\nmodel = \"sphere\"\nsize = \"2cm\"\n", ":1: lights", "'light'"},
  };
  for (const Mistake& mistake : mistakes) {
    const ScratchFolder folder;
    const auto path = folder / "s.toml";
    write(path, mistake.text);
    try {
      readScene(path);
      ADD_FAILURE() << "accepted:\n" << mistake.text;
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.kind(), Error::Kind::kInput) << what;
      EXPECT_EQ(what.rfind(path.string(), 0), 0u) << what;
      EXPECT_NE(error.parts().where.find(mistake.where), std::string::npos) << what;
      EXPECT_NE(what.find(mistake.mention), std::string::npos) << what;
    }
  }
}

TEST(SceneFile, BrokenTomlNamesTheLine) {
  const ScratchFolder folder;
  write(folder / "s.toml", "background = 0\n[[object\n");
  try {
    readScene(folder / "s.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.parts().where.find("s.toml:2"), std::string::npos) << error.what();
    EXPECT_EQ(error.kind(), Error::Kind::kInput);
  }
}

TEST(SceneFile, MissingFilesFoldersAndMeshes) {
  const ScratchFolder folder;
  EXPECT_THROW(readScene(folder / "none.toml"), Error);
  EXPECT_THROW(readScene(folder.path()), Error);
  write(folder / "s.toml", "[[object]]\nmodel = \"none.ply\"\nsize = \"2cm\"\n");
  EXPECT_THROW(readScene(folder / "s.toml"), Error);
}

TEST(LoadObject, KnowsBuiltInsAndSuggestsThem) {
  EXPECT_EQ(loadObject("knot").mesh, builtinMesh("knot"));
  EXPECT_EQ(loadObject("knot").model, "knot");
  try {
    loadObject("shpere");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'sphere'"), std::string::npos);
  }
}

}  // namespace
}  // namespace lychnite
