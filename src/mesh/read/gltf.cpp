#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "lychnite/base/error.h"
#include "mesh/read/gltf_animation.h"
#include "mesh/read/gltf_file.h"
#include "mesh/read/readers.h"

namespace lychnite {
namespace {

using nlohmann::json;

// Copies of one mesh under many nodes may add this much beyond the file's own size.
constexpr size_t kMostCopied = 16'000'000;

constexpr size_t kTriangles = 4, kStrip = 5, kFan = 6;

bool readable(const std::string& extension) {
  // These change how a surface looks or what is in the scene beside it, not where the triangles are.
  constexpr std::array<std::string_view, 4> kHarmless = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                         "KHR_lights_"};
  return extension == "KHR_mesh_quantization" ||
         std::any_of(kHarmless.begin(), kHarmless.end(),
                     [&](std::string_view start) { return extension.starts_with(start); });
}

class GltfReader {
 public:
  GltfReader(std::string_view bytes, const std::filesystem::path& path) : file_(bytes, path) {}

  GltfModel read() {
    const json& document = file_.document();
    for (const json& name : document.value("extensionsRequired", json::array()))
      if (!readable(name.get<std::string>()))
        file_.fail("a file without the extension " + name.get<std::string>().substr(0, 64),
                   "it listed as required", "export the model without it (and without mesh compression)");
    const size_t node_count = document.value("nodes", json::array()).size();
    visited_.assign(node_count, false);
    for (const size_t root : roots(node_count)) walk(root);
    // Normals are whole or nothing; a primitive without them leaves them short.
    if (mesh_.normals.size() != mesh_.positions.size()) mesh_.normals = {};
    GltfModel model;
    model.animation = readGltfAnimation(file_, parts_, mesh_);
    model.mesh = std::move(mesh_);
    if (model.animation && model.animation->deforms()) {
      PosedVertices posed = posedVertices(*model.animation, {}, 0);
      model.mesh.positions = std::move(posed.positions);
      model.mesh.normals = std::move(posed.normals);
    }
    return model;
  }

 private:
  struct Pending {
    size_t node;
    glm::dmat4 parent;
  };

  // The nodes of the scene that the file shows, or all that have no parent.
  std::vector<size_t> roots(size_t node_count) {
    const json& document = file_.document();
    std::vector<size_t> roots;
    if (document.contains("scenes")) {
      const json& scene = file_.item("scenes", file_.whole(document, "scene", 0));
      for (const json& node : scene.value("nodes", json::array())) roots.push_back(indexOf(node));
      return roots;
    }
    std::vector<bool> is_child(node_count, false);
    for (size_t n = 0; n < node_count; ++n)
      for (const json& child : file_.item("nodes", n).value("children", json::array()))
        if (indexOf(child) < node_count) is_child[indexOf(child)] = true;
    for (size_t n = 0; n < node_count; ++n)
      if (!is_child[n]) roots.push_back(n);
    return roots;
  }

  size_t indexOf(const json& value) const {
    if (!value.is_number_unsigned()) file_.fail("node numbers", "something else");
    return value.get<size_t>();
  }

  void walk(size_t root) {
    std::vector<Pending> pending = {{root, glm::dmat4(1)}};
    while (!pending.empty()) {
      const Pending next = pending.back();
      pending.pop_back();
      const json& node = file_.item("nodes", next.node);
      if (visited_[next.node])
        file_.fail("a tree of nodes",
                   "node " + std::to_string(next.node) + " under two parents or in a loop");
      visited_[next.node] = true;
      const glm::dmat4 transform = next.parent * gltfTransform(node);
      // Where a skinned mesh stands is its joints' affair.
      if (node.contains("mesh")) addMesh(next.node, node.contains("skin") ? glm::dmat4(1) : transform);
      const json children = node.value("children", json::array());
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        pending.push_back({indexOf(*child), transform});
    }
  }

  void addMesh(size_t node, const glm::dmat4& transform) {
    const size_t index = file_.whole(file_.item("nodes", node), "mesh");
    size_t number = 0;
    for (const json& primitive : file_.item("meshes", index).at("primitives")) {
      const size_t own = number++;
      const size_t mode = file_.whole(primitive, "mode", kTriangles);
      const json& attributes = primitive.at("attributes");
      if (mode < kTriangles || !attributes.contains("POSITION")) continue;
      if (mode > kFan) file_.fail("a primitive mode up to 6", std::to_string(mode));
      const size_t first = mesh_.positions.size();
      addVertices(attributes, transform);
      addTriangles(primitive, mode, first, glm::determinant(glm::dmat3(transform)) < 0);
      parts_.push_back({node, index, own, first, mesh_.positions.size() - first});
      const size_t most = kMostCopied + file_.bytesRead();
      if (mesh_.positions.size() > most || mesh_.triangles.size() > most)
        file_.fail("at most " + std::to_string(kMostCopied) + " copied triangles and vertices", "more",
                   "place fewer copies of its meshes");
    }
  }

  void addVertices(const json& attributes, const glm::dmat4& transform) {
    const bool whole_so_far = mesh_.normals.size() == mesh_.positions.size();
    const std::vector<glm::vec3> positions = file_.vectors(file_.whole(attributes, "POSITION"));
    for (const glm::dvec3 p : positions) mesh_.positions.push_back(transform * glm::dvec4(p, 1));
    if (!whole_so_far || !attributes.contains("NORMAL")) return;
    const std::vector<glm::vec3> normals = file_.vectors(file_.whole(attributes, "NORMAL"));
    if (normals.size() != positions.size())
      file_.fail("as many normals as positions", std::to_string(normals.size()));
    // The cofactors: the inverse transposed up to its scale, and right for singular and mirrored matrices
    // too.
    const glm::dmat3 m(transform);
    const double side = glm::determinant(m) < 0 ? -1 : 1;
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    for (const glm::dvec3 n : normals) {
      const glm::dvec3 turned = side * (cofactors * n);
      const double length = glm::length(turned);
      mesh_.normals.push_back(length > 0 ? turned / length : glm::dvec3(0));
    }
  }

  void addTriangles(const json& primitive, size_t mode, size_t first, bool mirrored) {
    const size_t count = mesh_.positions.size() - first;
    std::vector<uint32_t> order;
    if (primitive.contains("indices")) {
      for (const double index : file_.numbers(file_.whole(primitive, "indices"), 1)) {
        if (!(index >= 0 && index < static_cast<double>(count)) || index != std::floor(index))
          file_.fail("indices below the vertex count of " + std::to_string(count), std::to_string(index));
        order.push_back(static_cast<uint32_t>(first + static_cast<size_t>(index)));
      }
    } else {
      for (size_t v = first; v < mesh_.positions.size(); ++v) order.push_back(static_cast<uint32_t>(v));
    }
    const size_t step = mode == kTriangles ? 3 : 1;
    for (size_t i = 0; i + 2 < order.size(); i += step) {
      glm::uvec3 corners(order[i], order[i + 1], order[i + 2]);
      if (mode == kStrip && i % 2 == 1) std::swap(corners.y, corners.z);
      if (mode == kFan) corners.x = order[0];
      if (mirrored) std::swap(corners.y, corners.z);
      mesh_.triangles.push_back(corners);
    }
  }

  GltfFile file_;
  Mesh mesh_;
  std::vector<GltfPart> parts_;
  std::vector<bool> visited_;
};

// The JSON library quotes what it stumbled over, which may be long and may be no text.
std::string shortText(std::string text) {
  constexpr size_t kMost = 160;
  if (text.size() > kMost) text = text.substr(0, kMost) + "...";
  for (char& c : text)
    if (c < 32 || c >= 127) c = '?';
  return text;
}

}  // namespace

GltfModel readGltf(std::string_view bytes, const std::filesystem::path& path) {
  try {
    return GltfReader(bytes, path).read();
  } catch (const json::exception& e) {
    throw Error({.where = path.string(),
                 .expected = "a glTF 2 document",
                 .found = shortText(e.what()),
                 .todo = "the file is truncated or malformed: download or export it again"});
  }
}

}  // namespace lychnite
