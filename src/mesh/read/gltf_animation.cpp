#include "mesh/read/gltf_animation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <set>

namespace lychnite {
namespace {

using nlohmann::json;

// Many samplers, targets or skins may use the same data; this bounds what they add up to.
constexpr size_t kMostNumbers = 64'000'000;

glm::dvec3 vectorOf(const json& node, const char* member, const glm::dvec3& fallback) {
  const auto found = node.find(member);
  if (found == node.end()) return fallback;
  const auto v = found->get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}

glm::dquat rotationOf(const json& node) {
  const auto found = node.find("rotation");
  if (found == node.end()) return {1, 0, 0, 0};
  const auto q = found->get<std::array<double, 4>>();
  const glm::dquat turn(q[3], q[0], q[1], q[2]);
  return glm::length(turn) > 0 ? glm::normalize(turn) : glm::dquat(1, 0, 0, 0);
}

std::optional<glm::dmat4> matrixOf(const json& node) {
  const auto matrix = node.find("matrix");
  if (matrix == node.end()) return {};
  const auto values = matrix->get<std::array<double, 16>>();  // column-major, as GLM's
  return glm::make_mat4(values.data());
}

class AnimationReader {
 public:
  AnimationReader(GltfFile& file, const Mesh& placed) : file_(file) {
    data_.mesh.triangles = placed.triangles;
    withNormals_ = !placed.normals.empty();
    data_.mesh.positions.resize(placed.positions.size());
    if (withNormals_) data_.mesh.normals.resize(placed.positions.size());
  }

  AnimationData read(const std::vector<GltfPart>& parts) {
    readNodes();
    for (const json& skin : list("skins")) readSkin(skin);
    for (const GltfPart& part : parts) readPart(part);
    for (const json& animation : list("animations")) readClip(animation);
    return std::move(data_);
  }

 private:
  const json& list(const char* name) const {
    static const json kNone = json::array();
    const auto found = file_.document().find(name);
    return found == file_.document().end() ? kNone : *found;
  }

  void count(size_t numbers) {
    used_ += numbers;
    if (used_ > kMostNumbers)
      file_.fail("at most " + std::to_string(kMostNumbers) + " numbers of motion", "more");
  }

  std::vector<double> numbers(size_t accessor, size_t components) {
    std::vector<double> values = file_.numbers(accessor, components);
    count(values.size());
    for (const double v : values)
      if (!std::isfinite(v)) file_.fail("finite numbers of motion", std::to_string(v));
    return values;
  }

  std::vector<glm::vec3> vectors(size_t accessor, size_t count) {
    const std::vector<double> values = numbers(accessor, 3);
    if (values.size() != 3 * count)
      file_.fail("as many values as the " + std::to_string(count) + " vertices",
                 std::to_string(values.size() / 3));
    std::vector<glm::vec3> out(count);
    for (size_t i = 0; i < count; ++i) out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return out;
  }

  size_t nodeNumber(const json& value) const {
    if (!value.is_number_unsigned() || value.get<size_t>() >= data_.nodes.size())
      file_.fail("a node below the " + std::to_string(data_.nodes.size()) + " nodes", "another number");
    return value.get<size_t>();
  }

  void readNodes() {
    const json& nodes = list("nodes");
    data_.nodes.resize(nodes.size());
    for (size_t n = 0; n < nodes.size(); ++n) {
      const json& node = nodes[n];
      AnimationData::Node& out = data_.nodes[n];
      out.matrix = matrixOf(node);
      out.translation = vectorOf(node, "translation", glm::dvec3(0));
      out.rotation = rotationOf(node);
      out.scale = vectorOf(node, "scale", glm::dvec3(1));
      if (node.contains("mesh")) {
        const json& mesh = file_.item("meshes", file_.whole(node, "mesh"));
        out.weights = node.value("weights", mesh.value("weights", std::vector<double>()));
        count(out.weights.size());
      }
      for (const json& child : node.value("children", json::array())) {
        AnimationData::Node& kin = data_.nodes[nodeNumber(child)];
        if (kin.parent >= 0) file_.fail("a tree of nodes", "a node under two parents");
        kin.parent = int(n);
      }
    }
    sortNodes(nodes);
  }

  /// Parents first; what a loop of nodes holds is never reached.
  void sortNodes(const json& nodes) {
    for (size_t n = 0; n < nodes.size(); ++n)
      if (data_.nodes[n].parent < 0) data_.order.push_back(n);
    for (size_t i = 0; i < data_.order.size(); ++i)
      for (const json& child : nodes[data_.order[i]].value("children", json::array()))
        data_.order.push_back(child.get<size_t>());
    if (data_.order.size() != nodes.size()) file_.fail("a tree of nodes", "nodes in a loop");
  }

  void readSkin(const json& skin) {
    AnimationData::Skin out;
    for (const json& joint : skin.at("joints")) out.joints.push_back(nodeNumber(joint));
    out.inverseBind.assign(out.joints.size(), glm::dmat4(1));
    if (skin.contains("inverseBindMatrices")) {
      const std::vector<double> values = numbers(file_.whole(skin, "inverseBindMatrices"), 16);
      if (values.size() < 16 * out.joints.size())
        file_.fail("an inverse bind matrix for each joint", std::to_string(values.size() / 16));
      for (size_t j = 0; j < out.joints.size(); ++j) out.inverseBind[j] = glm::make_mat4(&values[16 * j]);
    }
    data_.skins.push_back(std::move(out));
  }

  void readPart(const GltfPart& part) {
    const json& node = file_.item("nodes", part.node);
    const json& primitive = file_.item("meshes", part.mesh).at("primitives").at(part.primitive);
    const json& attributes = primitive.at("attributes");
    AnimationData::Part out{.node = part.node, .first = part.first, .count = part.count};
    const auto from = [&](const char* name, std::vector<glm::vec3>& to) {
      const auto values = vectors(file_.whole(attributes, name), part.count);
      std::copy(values.begin(), values.end(), to.begin() + ptrdiff_t(part.first));
      used_ -= 3 * part.count;  // no motion; the file's size bounds it
    };
    from("POSITION", data_.mesh.positions);
    if (withNormals_) from("NORMAL", data_.mesh.normals);
    if (node.contains("skin")) readInfluences(file_.whole(node, "skin"), attributes, out);
    for (const json& target : primitive.value("targets", json::array())) {
      AnimationData::Target to;
      if (target.contains("POSITION")) to.positions = vectors(file_.whole(target, "POSITION"), part.count);
      if (withNormals_ && target.contains("NORMAL"))
        to.normals = vectors(file_.whole(target, "NORMAL"), part.count);
      out.targets.push_back(std::move(to));
    }
    data_.parts.push_back(std::move(out));
  }

  void readInfluences(size_t skin, const json& attributes, AnimationData::Part& out) {
    if (skin >= data_.skins.size())
      file_.fail("a skin below the " + std::to_string(data_.skins.size()), std::to_string(skin));
    out.skin = skin;
    std::vector<std::vector<double>> joints, weights;
    for (const char* set : {"0", "1"}) {
      const std::string joint = std::string("JOINTS_") + set, weight = std::string("WEIGHTS_") + set;
      if (!attributes.contains(joint)) break;
      joints.push_back(numbers(file_.whole(attributes, joint.c_str()), 4));
      weights.push_back(numbers(file_.whole(attributes, weight.c_str()), 4));
      if (joints.back().size() != 4 * out.count || weights.back().size() != 4 * out.count)
        file_.fail("joints and weights for each vertex", "another number of them");
    }
    out.influences = 4 * joints.size();
    for (size_t v = 0; v < out.count; ++v) addInfluences(v, joints, weights, out);
  }

  void addInfluences(size_t vertex, const std::vector<std::vector<double>>& joints,
                     const std::vector<std::vector<double>>& weights, AnimationData::Part& out) {
    const size_t count = data_.skins[*out.skin].joints.size();
    double sum = 0;
    for (const auto& set : weights)
      for (size_t k = 0; k < 4; ++k) sum += set[4 * vertex + k];
    for (size_t s = 0; s < joints.size(); ++s) {
      for (size_t k = 0; k < 4; ++k) {
        const double joint = joints[s][4 * vertex + k], weight = weights[s][4 * vertex + k];
        if (!(joint >= 0 && joint < double(count)) || weight < 0)
          file_.fail("joints below the skin's " + std::to_string(count) + " and weights of 0 or more",
                     std::to_string(joint) + " with " + std::to_string(weight));
        out.joints.push_back(uint32_t(joint));
        out.weights.push_back(float(sum > 0 ? weight / sum : s == 0 && k == 0 ? 1 : 0));
      }
    }
  }

  void readClip(const json& animation) {
    AnimationData::Clip clip;
    clip.name = ownName(animation.value("name", std::string()));
    const json& samplers = animation.at("samplers");
    for (const json& channel : animation.at("channels")) {
      const json& target = channel.at("target");
      if (!target.contains("node")) continue;
      const size_t node = nodeNumber(target.at("node"));
      const std::string path = target.at("path").get<std::string>();
      const auto& weights = data_.nodes[node].weights;
      AnimationData::Channel out{.node = node, .sampler = clip.samplers.size()};
      size_t components = 3;
      if (path == "rotation") {
        out.path = AnimationData::Path::kRotation;
        components = 4;
      } else if (path == "scale") {
        out.path = AnimationData::Path::kScale;
      } else if (path == "weights") {
        out.path = AnimationData::Path::kWeights;
        components = std::max(weights.size(), targetsOf(node));
      } else if (path != "translation") {
        continue;
      }
      if (components == 0) continue;
      clip.samplers.push_back(readSampler(samplers.at(file_.whole(channel, "sampler")), components));
      clip.channels.push_back(out);
    }
    if (!clip.channels.empty()) data_.clips.push_back(std::move(clip));
  }

  size_t targetsOf(size_t node) const {
    size_t most = 0;
    for (const auto& part : data_.parts)
      if (part.node == node) most = std::max(most, part.targets.size());
    return most;
  }

  std::string ownName(const std::string& name) {
    const std::string stem = name.empty() ? "animation" : name;
    std::string own = name.empty() ? stem + " " + std::to_string(data_.clips.size() + 1) : stem;
    for (int i = 2; !names_.insert(own).second; ++i) own = stem + " " + std::to_string(i);
    return own;
  }

  AnimationData::Sampler readSampler(const json& sampler, size_t components) {
    AnimationData::Sampler out;
    const std::string kind = sampler.value("interpolation", std::string("LINEAR"));
    if (kind == "STEP")
      out.interpolation = AnimationData::Interpolation::kStep;
    else if (kind == "CUBICSPLINE")
      out.interpolation = AnimationData::Interpolation::kCubicSpline;
    else if (kind != "LINEAR")
      file_.fail("STEP, LINEAR or CUBICSPLINE", kind.substr(0, 24));
    out.times = numbers(file_.whole(sampler, "input"), 1);
    if (out.times.empty() || !std::is_sorted(out.times.begin(), out.times.end()) || out.times.front() < 0)
      file_.fail("times of 0 s and later in order", "others");
    out.components = components;
    // Weights are single numbers, as many for each key as there are targets.
    const size_t output = file_.whole(sampler, "output");
    const bool single = file_.item("accessors", output).at("type").get<std::string>() == "SCALAR";
    out.values = numbers(output, single ? 1 : components);
    const size_t each = out.interpolation == AnimationData::Interpolation::kCubicSpline ? 3 : 1;
    if (out.values.size() != out.times.size() * each * components)
      file_.fail(std::to_string(out.times.size() * each * components) + " numbers of motion for " +
                     std::to_string(out.times.size()) + " times",
                 std::to_string(out.values.size()));
    return out;
  }

  GltfFile& file_;
  AnimationData data_;
  std::set<std::string> names_;
  size_t used_ = 0;
  bool withNormals_ = false;
};

}  // namespace

glm::dmat4 gltfTransform(const json& node) {
  if (const auto matrix = matrixOf(node)) return *matrix;
  const glm::dmat4 moved = glm::translate(glm::dmat4(1), vectorOf(node, "translation", glm::dvec3(0)));
  return glm::scale(moved * glm::mat4_cast(rotationOf(node)), vectorOf(node, "scale", glm::dvec3(1)));
}

std::optional<AnimationData> readGltfAnimation(GltfFile& file, const std::vector<GltfPart>& parts,
                                               const Mesh& placed) {
  const json& document = file.document();
  const bool morphs = std::any_of(parts.begin(), parts.end(), [&](const GltfPart& part) {
    return file.item("meshes", part.mesh).at("primitives").at(part.primitive).contains("targets");
  });
  if (!morphs && !document.contains("skins") && !document.contains("animations")) return {};
  return AnimationReader(file, placed).read(parts);
}

}  // namespace lychnite
