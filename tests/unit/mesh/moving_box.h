#pragma once

#include <string>
#include <utility>
#include <vector>

#include "unit/mesh/sample_files.h"

namespace sample {

/// The box of sample_files.h that moves: its upper corners (z = 3) hang on joint 2, which stands at z = 3,
/// its lower ones on joint 1; one morph target lifts all by 1. The accessors' numbers are below.
class MovingBox {
 public:
  enum Accessor {
    kPositions,
    kIndices,
    kJoints,
    kWeights,
    kInverseBind,
    kLift,
    kTimes,
    kTurns,
    kSpline,
    kFactors,
    kWild
  };

  MovingBox() {
    std::string joints, weights, bind, lift, times, turns, spline, factors, wild;
    for (const auto& corner : kCorners) {
      joints += std::string{char(corner.z > 0 ? 1 : 0), 0, 0, 0};
      for (const float w : {1.0f, 0.0f, 0.0f, 0.0f}) put(weights, w);
      put(lift, glm::vec3(0, 0, 1));
    }
    for (const float z : {0.0f, -3.0f})
      for (int i = 0; i < 16; ++i) put(bind, i == 14 ? z : i % 5 == 0 ? 1.0f : 0.0f);
    for (const float t : {0.0f, 2.0f}) put(times, t);
    // From no turn to a quarter turn about x.
    for (const float v : {0.0f, 0.0f, 0.0f, 1.0f, 0.70710678f, 0.0f, 0.0f, 0.70710678f}) put(turns, v);
    // z from 0 to 4, leaving with a speed of 1 and arriving with none.
    for (const float z : {0.0f, 0.0f, 1.0f, 0.0f, 4.0f, 0.0f}) put(spline, glm::vec3(0, 0, z));
    for (const float w : {0.0f, 1.0f}) put(factors, w);
    // Scales: of its joint's own size, and past the range of floats for what is farther than 1 from it.
    for (const float s : {1.0f, 3e38f}) put(wild, glm::vec3(s));
    std::string points, indices;
    for (const auto& p : kCorners) put(points, p);
    for (const auto& t : triangles())
      for (int i = 0; i < 3; ++i) put(indices, static_cast<uint16_t>(t[i]));
    add(points, 5126, 8, "VEC3");
    add(indices, 5123, 36, "SCALAR");
    add(joints, 5121, 8, "VEC4");
    add(weights, 5126, 8, "VEC4");
    add(bind, 5126, 2, "MAT4");
    add(lift, 5126, 8, "VEC3");
    add(times, 5126, 2, "SCALAR");
    add(turns, 5126, 2, "VEC4");
    add(spline, 5126, 6, "VEC3");
    add(factors, 5126, 2, "SCALAR");
    add(wild, 5126, 2, "VEC3");
  }

  /// With one animation a channel: node, path, output, interpolation.
  void animate(int node, const std::string& path, Accessor output, const std::string& kind = "LINEAR",
               const std::string& name = "") {
    animations_ +=
        (animations_.empty() ? "" : ",") + ("{" + (name.empty() ? "" : "\"name\":\"" + name + "\",")) +
        "\"channels\":[{\"sampler\":0,\"target\":{\"node\":" + std::to_string(node) + ",\"path\":\"" + path +
        "\"}}],\"samplers\":[{\"input\":6,\"output\":" + std::to_string(int(output)) +
        ",\"interpolation\":\"" + kind + "\"}]}";
  }

  std::string jointsTranslation = "[0,0,3]";  ///< of joint 2, whose inverse bind matrix says z = 3
  std::string more;                           ///< members of node 0

  std::string json() const {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"skin":0)" +
           more + R"(},{"children":[2]},{"translation":)" + jointsTranslation +
           R"(}],"skins":[{"joints":[1,2],"inverseBindMatrices":4}],"meshes":[{"primitives":[{"attributes":)"
           R"({"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1,"targets":[{"POSITION":5}]}]}],)" +
           (animations_.empty() ? "" : "\"animations\":[" + animations_ + "],") + "\"accessors\":[" +
           accessors_ + "],\"bufferViews\":[" + views_ +
           "],\"buffers\":[{\"byteLength\":" + std::to_string(buffer_.size()) + "}]}";
  }
  std::string glb() const { return sample::glb(json(), buffer_); }
  const std::string& buffer() const { return buffer_; }

 private:
  void add(const std::string& bytes, int component, int count, const std::string& type) {
    const std::string comma = views_.empty() ? "" : ",";
    accessors_ += comma + "{\"bufferView\":" + std::to_string(count_++) +
                  ",\"componentType\":" + std::to_string(component) + ",\"count\":" + std::to_string(count) +
                  ",\"type\":\"" + type + "\"}";
    views_ += comma + "{\"buffer\":0,\"byteOffset\":" + std::to_string(buffer_.size()) +
              ",\"byteLength\":" + std::to_string(bytes.size()) + "}";
    buffer_ += bytes;
    while (buffer_.size() % 4) buffer_ += '\0';
  }

  std::string buffer_, views_, accessors_, animations_;
  int count_ = 0;
};

}  // namespace sample
