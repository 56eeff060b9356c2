#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lychnite/mesh/mesh.h"

namespace lychnite {

/// What moves in a glTF 2.0 file, checked: every index is in range, parents come before their children in
/// `order`, times do not fall.
struct AnimationData {
  struct Node {
    int parent = -1;
    std::optional<glm::dmat4> matrix;  ///< in place of the three below; such a node cannot be animated
    glm::dvec3 translation{0}, scale{1};
    glm::dquat rotation{1, 0, 0, 0};
    std::vector<double> weights;  ///< of its mesh's morph targets
  };
  struct Skin {
    std::vector<size_t> joints;
    std::vector<glm::dmat4> inverseBind;  ///< as many
  };
  struct Target {
    std::vector<glm::vec3> positions,
        normals;  ///< added at weight 1; each empty or as many as the part's vertices
  };
  /// Consecutive vertices that move by one rule.
  struct Part {
    size_t node = 0, first = 0, count = 0;
    std::optional<size_t> skin;
    size_t influences = 0;  ///< joints a vertex
    std::vector<uint32_t> joints;
    std::vector<float> weights;  ///< as many; they add up to 1 for each vertex
    std::vector<Target> targets;
  };
  enum class Path { kTranslation, kRotation, kScale, kWeights };
  enum class Interpolation { kStep, kLinear, kCubicSpline };
  struct Sampler {
    Interpolation interpolation = Interpolation::kLinear;
    std::vector<double> times;
    size_t components = 0;       ///< numbers of one value
    std::vector<double> values;  ///< kCubicSpline: in-tangent, value, out-tangent for each key
  };
  struct Channel {
    size_t node = 0, sampler = 0;
    Path path = Path::kTranslation;
  };
  struct Clip {
    std::string name;
    std::vector<Sampler> samplers;
    std::vector<Channel> channels;
  };

  std::vector<Node> nodes;
  std::vector<size_t> order;  ///< of all nodes, parents first
  std::vector<Skin> skins;
  std::vector<Part> parts;
  std::vector<Clip> clips;
  Mesh mesh;  ///< vertices as the file has them, before any transform; normals empty or as many

  bool moves() const { return !clips.empty(); }
  /// Some vertex is not where its node alone puts it.
  bool deforms() const;
};

/// A sampler's value at a time (glTF 2.0, appendix C), clamped to its keys; rotations come out normalized.
std::vector<double> sampled(const AnimationData::Sampler& sampler, double seconds, bool rotation);

/// Positions and normals (empty like the data's) at a moment of a clip, or at rest without one.
struct PosedVertices {
  std::vector<glm::vec3> positions, normals;
};
PosedVertices posedVertices(const AnimationData& data, std::optional<size_t> clip, double seconds);

}  // namespace lychnite
