#include <fmt/format.h>

#include <array>

#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/optics/profile.h"

namespace lychnite {
namespace {

constexpr std::array<const char*, 4> kNames{"dipole", "better-dipole", "normalized-diffusion", "tabulated"};

}  // namespace

std::string profileName(ProfileKind kind) {
  return kNames[size_t(kind)];
}

ProfileKind parseProfileKind(std::string_view name, std::string_view where) {
  for (size_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i]) return ProfileKind(i);
  const std::vector<std::string> names(kNames.begin(), kNames.end());
  const std::string nearest = nearestName(name, names);
  throw Error({.where = std::string(where),
               .expected = "dipole, better-dipole, normalized-diffusion or tabulated",
               .found = fmt::format("'{}'", name),
               .todo = nearest.empty() ? "" : fmt::format("did you mean '{}'?", nearest)},
              Error::Kind::kUsage);
}

bool tellsOrdersApart(ProfileKind kind) {
  return kind == ProfileKind::kTabulated;
}

}  // namespace lychnite
