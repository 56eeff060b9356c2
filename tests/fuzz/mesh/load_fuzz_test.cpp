#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "fuzz/mesh/allocations.h"
#include "lychnite/base/error.h"
#include "lychnite/mesh/load.h"
#include "unit/mesh/sample_files.h"

namespace lychnite {
namespace {

// What every file of a few hundred bytes may cost at most, however hostile.
constexpr size_t kMostBytes = 256 * 1024;

class LoadFuzz : public testing::TestWithParam<size_t> {
 protected:
  LoadFuzz() : sample_(sample::all()[GetParam()]) { folder_.write("box.bin", sample::gltfBuffer()); }

  void expectSound(const Mesh& mesh) {
    ASSERT_FALSE(mesh.triangles.empty());
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
      ASSERT_TRUE(std::isfinite(glm::length(glm::dvec3(mesh.positions[v]))));
      ASSERT_NEAR(glm::length(mesh.normals[v]), 1.0f, 1e-5f);
    }
    for (const glm::uvec3& t : mesh.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
    ASSERT_GT(boundsOf(mesh).longestSide(), 0.0);
    ASSERT_GT(inspect(mesh).area, 0.0);
  }

  /// Either a sound mesh or one clear line; anything else (a crash, another exception, a huge allocation)
  /// fails.
  void loadsOrRefuses(std::string_view bytes, const std::string& what) {
    SCOPED_TRACE(what);
    const auto path = folder_.write(sample_.file_name, bytes);
    resetLargestAllocation();
    try {
      expectSound(*loadMesh(path).mesh);
      ++loaded_;
    } catch (const Error& e) {
      const std::string line = e.what();
      EXPECT_NE(line.find(folder_.path().string()), std::string::npos) << line;
      EXPECT_LT(line.size(), 600u + folder_.path().string().size()) << line;
      EXPECT_EQ(line.find_first_of("\r\n"), std::string::npos) << line;
      ++refused_;
    }
    EXPECT_LT(largestAllocation(), kMostBytes);
  }

  const sample::Named sample_;
  sample::Folder folder_;
  size_t loaded_ = 0, refused_ = 0;
};

TEST_P(LoadFuzz, Truncations) {
  for (size_t size = 1; size < sample_.bytes.size(); ++size)
    loadsOrRefuses(std::string_view(sample_.bytes).substr(0, size), "cut to " + std::to_string(size));
  // A text format may lose its last words (a line end, a colour) and still be whole. An OBJ has no counts and
  // no end mark: cut after a face, nothing tells that more was meant.
  if (!sample_.file_name.ends_with(".obj")) {
    EXPECT_LE(loaded_, 12u);
  }
}

TEST_P(LoadFuzz, ChangedBytes) {
  const std::array<std::function<char(char)>, 4> changes = {
      [](char c) -> char { return c ^ 1; }, [](char c) -> char { return c ^ -128; },
      [](char) -> char { return -1; }, [](char) -> char { return '9'; }};
  for (size_t at = 0; at < sample_.bytes.size(); ++at) {
    for (const auto& change : changes) {
      std::string bytes = sample_.bytes;
      bytes[at] = change(bytes[at]);
      loadsOrRefuses(bytes, "byte " + std::to_string(at));
    }
  }
  EXPECT_GT(loaded_, 0u);
  EXPECT_GT(refused_, 0u);
}

TEST_P(LoadFuzz, ShuffledPieces) {
  std::mt19937 random(7);
  const auto below = [&](size_t n) { return random() % n; };
  for (int round = 0; round < 300; ++round) {
    std::string bytes = sample_.bytes;
    for (size_t edits = 1 + below(4); edits > 0; --edits) {
      const size_t at = below(bytes.size()), size = 1 + below(16);
      const std::string piece = bytes.substr(at, size);
      switch (below(4)) {
        case 0:
          bytes.erase(at, size);
          break;
        case 1:
          bytes.insert(below(bytes.size()), piece);
          break;
        case 2:
          bytes[at] = static_cast<char>(random());
          break;
        default:
          bytes.replace(at, 4, "\xff\xff\xff\x7f");
          break;
      }
      if (bytes.empty()) bytes = "x";
    }
    loadsOrRefuses(bytes, "round " + std::to_string(round));
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, LoadFuzz, testing::Range<size_t>(0, sample::all().size()),
                         [](const auto& format) {
                           std::string name = sample::all()[format.param].file_name;
                           name[name.find('.')] = '_';
                           return name;
                         });

}  // namespace
}  // namespace lychnite
