// The commands that print: keys that scripts may rely on, and values that are known.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "e2e/runner.h"

namespace lychnite::e2e {
namespace {

using Json = nlohmann::json;

Json jsonOf(const Result& result) {
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return Json::parse(result.out);
}

TEST(Compare, APictureWithItselfIsZero) {
  const Scratch scratch;
  ASSERT_EQ(scratch.run(renderArguments("stone", {"--size", "10mm", "-o", "a.exr"})).status, 0);
  const Json json = jsonOf(scratch.run({"compare", "a.exr", "a.exr", "--json", "--heatmap", "map.png"}));
  for (const char* key :
       {"relative_rmse", "bias", "best_gain", "relative_rmse_after_gain", "psnr", "ssim", "flip", "channels"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["relative_rmse"], 0);
  EXPECT_EQ(json["bias"], 0);
  EXPECT_EQ(json["flip"], 0);
  EXPECT_EQ(json["best_gain"], 1);
  for (const char* channel : {"r", "g", "b"})
    EXPECT_EQ(json["channels"][channel]["relative_rmse"], 0) << channel;
  EXPECT_EQ(scratch.names(), (std::set<std::string>{"a.exr", "map.png"}));
}

TEST(Compare, TwiceTheLightIsAGainOfAHalf) {
  const Scratch scratch;
  for (const char* power : {"1", "2"}) {
    const Result result = scratch.run(
        renderArguments("stone", {"--size", "10mm", "--light", std::string("parallel:40,30,") + power, "-o",
                                  std::string(power) + ".exr"}));
    ASSERT_EQ(result.status, 0) << result.err;
  }
  const Json json = jsonOf(scratch.run({"compare", "2.exr", "1.exr", "--json"}));
  EXPECT_NEAR(json["best_gain"], 0.5, 1e-4);
  EXPECT_NEAR(json["bias"], 1, 1e-3);
  EXPECT_LT(json["relative_rmse_after_gain"], 1e-3);
}

// A half-space of albedo 0.9 that scatters evenly, no boundary: 1 - H(1) sqrt(1 - albedo) with H(1) = 1.8501
// [Chandrasekhar 1960, ch. 5 and tab. XI] at normal incidence.
TEST(Slab, KeysAndAKnownReflectance) {
  const Scratch scratch;
  const Json json = jsonOf(scratch.run(
      {"slab", "--sigma-s", "0.9", "--sigma-a", "0.1", "--eta", "1", "--photons", "40000", "--json"}));
  for (const char* key : {"diffuse_reflectance", "specular_reflectance", "total_transmittance",
                          "unscattered_transmittance", "absorbed"}) {
    ASSERT_TRUE(json.contains(key)) << key;
    EXPECT_TRUE(json.contains(std::string(key) + "_se")) << key;
  }
  EXPECT_NEAR(json["diffuse_reflectance"], 0.4149, 5 * double(json["diffuse_reflectance_se"]));
  EXPECT_EQ(json["specular_reflectance"], 0);
  EXPECT_EQ(json["total_transmittance"], 0);
  EXPECT_NEAR(double(json["diffuse_reflectance"]) + double(json["absorbed"]), 1,
              5 * double(json["absorbed_se"]));
}

TEST(Slab, ThinSlabLetsTheRestThrough) {
  const Scratch scratch;
  const Json json = jsonOf(scratch.run({"slab", "--sigma-s", "1", "--sigma-a", "0", "--eta", "1",
                                        "--thickness", "1mm", "--photons", "20000", "--json"}));
  EXPECT_NEAR(json["unscattered_transmittance"], std::exp(-1.0), 1e-6);
  EXPECT_NEAR(double(json["diffuse_reflectance"]) + double(json["total_transmittance"]), 1,
              5 * double(json["total_transmittance_se"]));
}

TEST(Info, AWrittenPly) {
  const Scratch scratch;
  // A tetrahedron with its first vertex written twice, one unused vertex, and one triangle without area.
  scratch.write(
      "t.ply",
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 5\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n2 0 0\n0 1 0\n0 0 1\n0 0 0\n1 1 1\n"
      "3 0 2 1\n3 4 1 3\n3 1 2 3\n3 4 3 2\n3 0 1 4\n");
  const Json json = jsonOf(scratch.run({"info", "t.ply", "--json"}));
  EXPECT_EQ(json["triangles"], 4);
  EXPECT_EQ(json["vertices"], 4);
  EXPECT_EQ(json["closed"], true);
  EXPECT_EQ(json["components"], 1);
  EXPECT_EQ(json["boundary_edges"], 0);
  EXPECT_EQ(json["bounds"]["max"], (Json{2, 1, 1}));
  EXPECT_NEAR(json["volume"], 1.0 / 3, 1e-6);
  EXPECT_EQ(json["file"]["vertices"], 6);
  EXPECT_EQ(json["file"]["triangles"], 5);
  EXPECT_EQ(json["file"]["duplicate_vertices"], 1);
  EXPECT_EQ(json["file"]["degenerate_triangles"], 1);
  EXPECT_EQ(json["file"]["unused_vertices"], 1);
  EXPECT_TRUE(json.contains("load_seconds"));
}

TEST(Lists, Materials) {
  const Scratch scratch;
  const Json json = jsonOf(scratch.run({"materials", "--json"}));
  EXPECT_GE(json.size(), 12u);
  bool marble = false;
  for (const Json& material : json) {
    for (const char* key : {"name", "source", "sigma_s", "sigma_a", "mean_free_path_mm", "albedo",
                            "transport_length_mm", "diffuse_reflectance"})
      EXPECT_TRUE(material.contains(key)) << key;
    marble =
        marble || (material["name"] == "marble" && material["eta"] == 1.5 && material["sigma_s"][0] == 2.19);
  }
  EXPECT_TRUE(marble);
  const Result words = scratch.run({"materials"});
  EXPECT_EQ(words.status, 0);
  EXPECT_NE(words.out.find("\nspectralon"), std::string::npos);
}

TEST(Lists, Models) {
  const Scratch scratch;
  const Result result = scratch.run({"models"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* name : {"sphere", "slab", "knot", "stone", "candle", "figurine"})
    EXPECT_NE(result.out.find(name), std::string::npos) << name;
}

TEST(Lists, HelpAndVersion) {
  const Scratch scratch;
  const Result help = scratch.run({"--help"}), version = scratch.run({"--version"});
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.out.find("render"), std::string::npos);
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.rfind("lychnite ", 0), 0u) << version.out;
}

}  // namespace
}  // namespace lychnite::e2e
