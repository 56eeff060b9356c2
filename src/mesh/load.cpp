#include "lychnite/mesh/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "lychnite/base/error.h"
#include "mesh/read/file_bytes.h"
#include "mesh/read/readers.h"

namespace lychnite {
namespace {

struct Format {
  std::string_view extension, name;
  GltfModel (*read)(std::string_view bytes, const std::filesystem::path& path);
};

/// A format without motion.
template <Mesh (*kRead)(std::string_view, const std::string&)>
GltfModel still(std::string_view bytes, const std::filesystem::path& path) {
  return {kRead(bytes, path.string()), {}};
}

constexpr std::array kFormats = {
    Format{".ply", "PLY", still<readPly>}, Format{".obj", "OBJ", still<readObj>},
    Format{".stl", "STL", still<readStl>}, Format{".off", "OFF", still<readOff>},
    Format{".3ds", "3DS", still<read3ds>}, Format{".gltf", "glTF", readGltf},
    Format{".glb", "glTF", readGltf},
};

const Format& formatOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c += 'a' - 'A';
  std::string known, found = "no extension";
  for (const Format& format : kFormats) {
    if (format.extension == extension) return format;
    if (!known.empty()) known += ' ';
    known += format.extension;
  }
  if (!extension.empty()) found.assign("the extension '").append(extension).append("'");
  throw Error({.where = path.string(),
               .expected = fmt::format("a mesh file ({})", known),
               .found = found,
               .todo = "convert the model to one of them"});
}

// The format that a file's first bytes give away, or "".
std::string_view sniff(std::string_view bytes) {
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return "PLY";
  if (bytes.starts_with("glTF")) return "glTF";
  if (bytes.starts_with("MM") && bytes.size() > 3) return "3DS";
  if (bytes.starts_with("solid ") || bytes.starts_with("solid\n")) return "STL";
  const std::string_view start = bytes.substr(0, bytes.find_first_of(" \r\n"));
  if (start.size() <= 6 && start.ends_with("OFF")) return "OFF";
  if (start.starts_with("{")) return "glTF";
  if (start.starts_with("\x89PNG")) return "PNG (a picture)";
  if (start.starts_with("PK\x03\x04")) return "ZIP (an archive)";
  return "";
}

GltfModel readAs(const Format& format, std::string_view bytes, const std::filesystem::path& path) {
  try {
    return format.read(bytes, path);
  } catch (const Error&) {
    const std::string_view looks_like = sniff(bytes);
    if (looks_like.empty() || looks_like == format.name) throw;
    throw Error({.where = path.string(),
                 .expected = std::string(format.name) + ", as the extension says",
                 .found = "content that begins like " + std::string(looks_like),
                 .todo = "rename or convert the file"});
  }
}

/// Does to what moves as was done to the mesh at rest.
void repairLike(const RepairReport& report, AnimationData& moving) {
  if (report.flipped)
    for (glm::uvec3& t : moving.mesh.triangles) std::swap(t.y, t.z);
  if (report.normals_made) moving.mesh.normals.clear();  // made anew for each pose
  if (!report.normals_turned) return;
  for (glm::vec3& n : moving.mesh.normals) n = -n;
  for (AnimationData::Part& part : moving.parts)
    for (AnimationData::Target& target : part.targets)
      for (glm::vec3& n : target.normals) n = -n;
}

}  // namespace

LoadedMesh loadMesh(const std::filesystem::path& path, const LogSink& log) {
  const auto start = std::chrono::steady_clock::now();
  const auto secondsSoFar = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  refuseUnlessFile(path);
  const Format& format = formatOf(path);
  GltfModel model = readAs(format, readWholeFile(path), path);
  const double read_seconds = secondsSoFar();
  LoadedMesh loaded = repairMesh(std::move(model.mesh), path.string());
  if (model.animation && model.animation->moves()) {
    repairLike(loaded.report, *model.animation);
    loaded.animation = std::make_shared<const MeshAnimation>(std::move(*model.animation), loaded.mesh);
  }
  loaded.seconds = secondsSoFar();
  logTo(log, LogLevel::kDebug,
        path.string() + ": read in " + std::to_string(read_seconds) + " s, repaired in " +
            std::to_string(loaded.seconds - read_seconds) + " s");
  return loaded;
}

}  // namespace lychnite
