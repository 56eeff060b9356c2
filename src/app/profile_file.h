#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lychnite/optics/tabulated_profile.h"
#include "lychnite/reference/measure_profile.h"

namespace lychnite {

/// What a measured profile depends on, as text: the format's version, albedo, g, eta, photons, seed.
std::string profileFileKey(const ProfileMeasurement& measurement);
/// "profile-<hash of the key>.json".
std::string profileFileName(const std::string& key);

/// A measured profile as JSON with its key and a checksum.
std::string profileFileText(const MeasuredProfile& profile, const std::string& key);
/// Nothing where the text is not a whole profile of that key.
std::optional<MeasuredProfile> parseProfileFile(std::string_view text, const std::string& key);

}  // namespace lychnite
