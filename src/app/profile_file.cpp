#include "app/profile_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace lychnite {
namespace {

using Json = nlohmann::ordered_json;
using Part = MeasuredProfile::Part;

constexpr int kVersion = 1;

/// FNV-1a, 64 bits.
uint64_t hashOf(std::string_view text) {
  uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : text) hash = (hash ^ uint64_t(uint8_t(c))) * 0x100000001b3ull;
  return hash;
}

Json rgbJson(const Rgb& v) {
  return Json::array({v.x, v.y, v.z});
}

Rgb rgbFrom(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Json listJson(const std::vector<Rgb>& list) {
  Json json = Json::array();
  for (const Rgb& v : list) json.push_back(rgbJson(v));
  return json;
}

Json partJson(const Part& part) {
  return {{"total", rgbJson(part.total)},
          {"exitance", listJson(part.exitance)},
          {"deviation", listJson(part.deviation)}};
}

Part partFrom(const Json& json) {
  Part part{rgbFrom(json.at("total")), {}, {}};
  for (const Json& v : json.at("exitance")) part.exitance.push_back(rgbFrom(v));
  for (const Json& v : json.at("deviation")) part.deviation.push_back(rgbFrom(v));
  return part;
}

Json bodyJson(const MeasuredProfile& profile) {
  return {{"ring_edges", profile.ringEdges},
          {"all", partJson(profile.all)},
          {"from_second", partJson(profile.fromSecond)}};
}

bool whole(const MeasuredProfile& p) {
  if (p.ringEdges.size() < 6 || p.ringEdges.front() != 0) return false;
  for (size_t i = 1; i < p.ringEdges.size(); ++i)
    if (!(p.ringEdges[i] > p.ringEdges[i - 1])) return false;
  for (const Part* part : {&p.all, &p.fromSecond})
    if (part->exitance.size() + 1 != p.ringEdges.size() || part->deviation.size() != part->exitance.size())
      return false;
  return true;
}

}  // namespace

std::string profileFileKey(const ProfileMeasurement& m) {
  return fmt::format("version {} albedo {:.9g} {:.9g} {:.9g} g {:.9g} eta {:.9g} photons {} seed {}",
                     kVersion, m.albedo.x, m.albedo.y, m.albedo.z, m.g, m.eta, m.photons, m.seed);
}

std::string profileFileName(const std::string& key) {
  return fmt::format("profile-{:016x}.json", hashOf(key));
}

std::string profileFileText(const MeasuredProfile& profile, const std::string& key) {
  const Json body = bodyJson(profile);
  return Json{{"key", key}, {"checksum", fmt::format("{:016x}", hashOf(body.dump()))}, {"profile", body}}
             .dump(1) +
         "\n";
}

std::optional<MeasuredProfile> parseProfileFile(std::string_view text, const std::string& key) {
  try {
    const Json json = Json::parse(text);
    const Json& body = json.at("profile");
    if (json.at("key") != key || json.at("checksum") != fmt::format("{:016x}", hashOf(body.dump())))
      return {};
    MeasuredProfile profile{.ringEdges = body.at("ring_edges").get<std::vector<double>>(),
                            .all = partFrom(body.at("all")),
                            .fromSecond = partFrom(body.at("from_second"))};
    if (!whole(profile)) return {};
    return profile;
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

}  // namespace lychnite
