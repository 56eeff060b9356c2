#include "lychnite/app/report.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "lychnite/app/image_maker.h"
#include "lychnite/optics/profile.h"

namespace lychnite {
namespace {

using Json = nlohmann::ordered_json;

Json rgb(const glm::dvec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json metricsJson(const Metrics& m) {
  return {{"relative_rmse", m.relative_rmse},
          {"bias", m.bias},
          {"best_gain", m.best_gain},
          {"relative_rmse_after_gain", m.relative_rmse_after_gain},
          {"psnr", m.psnr},
          {"ssim", m.ssim}};
}

std::string text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

size_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return size_t(usage.ru_maxrss) * 1024;
}

std::string statsJson(const Image& image, const RenderSettings& settings, const RenderStats* stats,
                      double seconds) {
  Json json{{"lychnite", versionText()},
            {"method", image.metadata.at("method")},
            {"profile", profileName(settings.profile)},
            {"components", componentsName(settings.components)},
            {"width", image.width()},
            {"height", image.height()},
            {"seconds", seconds},
            {"peak_memory_bytes", peakMemoryBytes()}};
  if (stats) {
    json["device"] = stats->device;
    json["driver"] = stats->driver;
    json["software"] = stats->software;
    json["triangles"] = stats->triangles;
    json["vertices"] = stats->vertices;
    json["covered_pixels"] = stats->coveredPixels;
    json["map_size"] = stats->mapSize;
    json["single_samples"] = settings.singleSamples;
    json["map_bytes"] = stats->mapBytes;
    json["gpu_bytes"] = stats->gpuBytes;
    json["frame_ms"] = stats->frameMs;
    for (const RenderStats::Pass& pass : stats->passes)
      json["passes"].push_back({{"name", pass.name}, {"gpu_ms", pass.gpuMs}, {"runs", pass.runs}});
  }
  for (const auto& [key, value] : image.metadata)
    if (key != "scene") json["metadata"][key] = value;
  return text(json);
}

std::string comparisonJson(const Comparison& comparison) {
  Json json = metricsJson(comparison.together);
  json["flip"] = comparison.flip;
  json["pixels"] = comparison.pixels;
  const char* names[] = {"r", "g", "b"};
  for (size_t c = 0; c < 3; ++c) json["channels"][names[c]] = metricsJson(comparison.channels[c]);
  return text(json);
}

std::string infoJson(const std::string& model, const MeshInfo& info, const LoadedMesh* loaded) {
  Json json{{"model", model},
            {"triangles", info.triangles},
            {"vertices", info.vertices},
            {"closed", info.closed},
            {"boundary_edges", info.boundary_edges},
            {"non_manifold_edges", info.non_manifold_edges},
            {"components", info.components},
            {"bounds", {{"min", rgb(info.bounds.min)}, {"max", rgb(info.bounds.max)}}},
            {"area", info.area},
            {"volume", info.volume},
            {"memory_bytes", info.memory_bytes}};
  if (loaded) {
    const RepairReport& r = loaded->report;
    json["file"] = {{"vertices", r.file_vertices},
                    {"triangles", r.file_triangles},
                    {"duplicate_vertices", r.duplicate_vertices},
                    {"degenerate_triangles", r.degenerate_triangles},
                    {"unused_vertices", r.unused_vertices},
                    {"normals_made", r.normals_made},
                    {"flipped", r.flipped}};
    json["animations"] = Json::array();
    if (loaded->animation)
      for (const MeshAnimation::Clip& clip : loaded->animation->clips())
        json["animations"].push_back({{"name", clip.name}, {"seconds", clip.seconds}});
    json["load_seconds"] = loaded->seconds;
  }
  return text(json);
}

std::string materialsJson() {
  Json json = Json::array();
  for (const NamedCoefficients& material : materialLibrary()) {
    const Coefficients& m = material.coefficients;
    const Rgb sigma_tr = m.sigma_tr();
    Json lengths = Json::array();
    for (int c = 0; c < 3; ++c) lengths.push_back(sigma_tr[c] > 0 ? Json(1 / sigma_tr[c]) : Json(nullptr));
    json.push_back({{"name", material.name},
                    {"source", material.source},
                    {"sigma_s", rgb(m.sigma_s)},
                    {"sigma_a", rgb(m.sigma_a)},
                    {"g", m.g},
                    {"eta", m.eta},
                    {"mean_free_path_mm", rgb(m.mean_free_path())},
                    {"albedo", rgb(m.albedo())},
                    {"transport_length_mm", lengths},
                    {"diffuse_reflectance", rgb(makeDipole(m)->P(0))}});
  }
  return text(json);
}

}  // namespace lychnite
