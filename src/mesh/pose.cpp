// Poses of a glTF 2.0 file's meshes: appendix C (interpolation), section 3.7 (skins, morph targets).
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "mesh/animation_data.h"

namespace lychnite {
namespace {

using Node = AnimationData::Node;
using Part = AnimationData::Part;

glm::dquat quaternion(const std::vector<double>& xyzw) {
  return glm::dquat(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
}

glm::dmat4 localTransform(const Node& node) {
  if (node.matrix) return *node.matrix;
  return glm::scale(glm::translate(glm::dmat4(1), node.translation) * glm::mat4_cast(node.rotation),
                    node.scale);
}

void apply(const AnimationData::Clip& clip, double seconds, std::vector<Node>& nodes) {
  using Path = AnimationData::Path;
  for (const auto& channel : clip.channels) {
    Node& node = nodes[channel.node];
    const bool turns = channel.path == Path::kRotation;
    std::vector<double> v = sampled(clip.samplers[channel.sampler], seconds, turns);
    if (turns)
      node.rotation = quaternion(v);
    else if (channel.path == Path::kTranslation)
      node.translation = {v[0], v[1], v[2]};
    else if (channel.path == Path::kScale)
      node.scale = {v[0], v[1], v[2]};
    else
      node.weights = std::move(v);
  }
}

/// Turns normals: the inverse transposed up to its scale, and right for singular and mirrored matrices too.
glm::dvec3 turned(const glm::dmat3& m, const glm::dvec3& normal) {
  const double side = glm::determinant(m) < 0 ? -1 : 1;
  const glm::dvec3 result = side * (normal.x * glm::cross(m[1], m[2]) + normal.y * glm::cross(m[2], m[0]) +
                                    normal.z * glm::cross(m[0], m[1]));
  const double length = glm::length(result);
  return length > 0 && std::isfinite(length) ? result / length : glm::dvec3(0, 1, 0);
}

class Poser {
 public:
  Poser(const AnimationData& data, std::vector<Node> nodes) : data_(data), nodes_(std::move(nodes)) {
    toWorld_.resize(nodes_.size());
    for (const size_t n : data_.order) {
      const int parent = nodes_[n].parent;
      toWorld_[n] =
          parent < 0 ? localTransform(nodes_[n]) : toWorld_[size_t(parent)] * localTransform(nodes_[n]);
    }
  }

  PosedVertices posed() const {
    PosedVertices out{data_.mesh.positions, data_.mesh.normals};
    for (const Part& part : data_.parts) {
      morph(part, out);
      place(part, out);
    }
    return out;
  }

 private:
  void morph(const Part& part, PosedVertices& out) const {
    const std::vector<double>& weights = nodes_[part.node].weights;
    for (size_t t = 0; t < std::min(weights.size(), part.targets.size()); ++t) {
      const float w = float(weights[t]);
      if (w == 0) continue;
      const auto add = [&](const std::vector<glm::vec3>& by, std::vector<glm::vec3>& to) {
        for (size_t i = 0; i < by.size() && !to.empty(); ++i) to[part.first + i] += w * by[i];
      };
      add(part.targets[t].positions, out.positions);
      add(part.targets[t].normals, out.normals);
    }
  }

  std::vector<glm::dmat4> jointsOf(const Part& part) const {
    const AnimationData::Skin& skin = data_.skins[*part.skin];
    std::vector<glm::dmat4> joints;
    for (size_t j = 0; j < skin.joints.size(); ++j)
      joints.push_back(toWorld_[skin.joints[j]] * skin.inverseBind[j]);
    return joints;
  }

  void place(const Part& part, PosedVertices& out) const {
    const bool skinned = part.skin && part.influences > 0;
    const std::vector<glm::dmat4> joints = skinned ? jointsOf(part) : std::vector<glm::dmat4>();
    for (size_t i = 0; i < part.count; ++i) {
      glm::dmat4 m = toWorld_[part.node];
      if (skinned) {
        m = glm::dmat4(0);
        for (size_t k = i * part.influences; k < (i + 1) * part.influences; ++k)
          if (part.weights[k] != 0) m += double(part.weights[k]) * joints[part.joints[k]];
      }
      glm::vec3& p = out.positions[part.first + i];
      p = m * glm::dvec4(p, 1);
      if (out.normals.empty()) continue;
      glm::vec3& n = out.normals[part.first + i];
      n = turned(glm::dmat3(m), n);
    }
  }

  const AnimationData& data_;
  std::vector<Node> nodes_;
  std::vector<glm::dmat4> toWorld_;
};

}  // namespace

bool AnimationData::deforms() const {
  return std::any_of(parts.begin(), parts.end(), [&](const Part& part) {
    const auto& weights = nodes[part.node].weights;
    return part.skin || std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0; });
  });
}

std::vector<double> sampled(const AnimationData::Sampler& sampler, double seconds, bool rotation) {
  using Interpolation = AnimationData::Interpolation;
  const bool cubic = sampler.interpolation == Interpolation::kCubicSpline;
  const auto& times = sampler.times;
  const size_t n = sampler.components,
               next = size_t(std::upper_bound(times.begin(), times.end(), seconds) - times.begin());
  const size_t high = std::min(next, times.size() - 1), low = next == 0 ? 0 : next - 1;
  const double span = times[high] - times[low];
  const double t = span > 0 ? std::clamp((seconds - times[low]) / span, 0.0, 1.0) : 0;
  // Of a key: 0 in-tangent, 1 value, 2 out-tangent; or its value alone.
  const auto number = [&](size_t key, size_t which, size_t c) {
    return sampler.values[cubic ? (3 * key + which) * n + c : key * n + c];
  };
  std::vector<double> v(n);
  if (sampler.interpolation == Interpolation::kLinear && rotation) {
    const auto turn = [&](size_t key) {
      return glm::normalize(
          glm::dquat(number(key, 1, 3), number(key, 1, 0), number(key, 1, 1), number(key, 1, 2)));
    };
    const glm::dquat q = glm::slerp(turn(low), turn(high), t);
    return {q.x, q.y, q.z, q.w};
  }
  for (size_t c = 0; c < n; ++c) {
    const double a = number(low, 1, c), b = number(high, 1, c);
    if (sampler.interpolation == Interpolation::kStep)
      v[c] = a;
    else if (!cubic)
      v[c] = (1 - t) * a + t * b;
    else
      v[c] = (2 * t * t * t - 3 * t * t + 1) * a + span * (t * t * t - 2 * t * t + t) * number(low, 2, c) +
             (-2 * t * t * t + 3 * t * t) * b + span * (t * t * t - t * t) * number(high, 0, c);
  }
  if (rotation) {
    const glm::dquat q = quaternion(v);
    const double length = glm::length(q);
    v = length > 0 ? std::vector<double>{q.x / length, q.y / length, q.z / length, q.w / length}
                   : std::vector<double>{0, 0, 0, 1};
  }
  return v;
}

PosedVertices posedVertices(const AnimationData& data, std::optional<size_t> clip, double seconds) {
  std::vector<Node> nodes = data.nodes;
  if (clip) apply(data.clips[*clip], seconds, nodes);
  return Poser(data, std::move(nodes)).posed();
}

}  // namespace lychnite
