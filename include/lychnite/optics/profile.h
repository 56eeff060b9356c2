#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lychnite/base/progress.h"
#include "lychnite/optics/coefficients.h"

namespace lychnite {

/// A radially symmetric diffusion profile of a half-space: what every real-time method needs of a material.
/// r in mm. Rd(r) in 1/mm^2 is the radiosity at distance r from unit entering flux; P(r) is the integral of
/// Rd(r') 2 pi r' from r to infinity, so P(0) is the total diffuse reflectance under uniform light.
class Profile {
 public:
  virtual ~Profile() = default;
  virtual Rgb Rd(double r) const = 0;
  virtual Rgb P(double r) const = 0;
  /// Length in mm, per channel, over which the profile's peak is flat (zr of the dipole): sets the table's
  /// scale.
  virtual Rgb coreLength() const = 0;
  /// 1/mm, per channel: the slowest exponential decay of the tail, 0 where it only falls as a power.
  virtual Rgb tailDecay() const = 0;
};

/// Every profile of --profile.
enum class ProfileKind { kDipole, kBetterDipole, kNormalizedDiffusion, kTabulated };

/// "dipole", "better-dipole", "normalized-diffusion", "tabulated".
std::string profileName(ProfileKind kind);
/// Throws Error (Kind::kUsage) with the nearest name.
ProfileKind parseProfileKind(std::string_view name, std::string_view where);

/// The standard dipole [J01 eq. 4], P in closed form (docs/physics.md). Channels with sigma_sp = 0 are 0.
std::unique_ptr<Profile> makeDipole(const Coefficients& coefficients);

/// d'Eon 2012, "A Better Dipole": Grosjean's diffusion coefficient, exact internal moments and an exitance of
/// fluence and flux; P in closed form. Its alpha_p^2 leaves the first order out. Channels with sigma_sp = 0
/// are 0.
std::unique_ptr<Profile> makeBetterDipole(const Coefficients& coefficients);

/// Christensen & Burley 2015, the form for diffuse transmission at the surface, with l = 1/sigma_tp, their
/// albedo from the medium (the inverse of albedoFromColour) and the total corrected for internal reflection
/// (Saunderson 1942). P is exact. Rd grows like 1/r: below a thousandth of coreLength it is its mean over
/// that disc, so that Rd(0) is finite and the total is kept. Channels with sigma_sp = 0 are 0.
std::unique_ptr<Profile> makeNormalizedDiffusion(const Coefficients& coefficients);

/// Which orders of scattering a profile is asked to hold. Only kTabulated can tell them apart
/// (docs/physics.md); the formulas hold what they were derived for.
enum class ProfileOrders { kAll, kFromSecond };
bool tellsOrdersApart(ProfileKind kind);

struct ProfileRequest {
  ProfileKind kind = ProfileKind::kDipole;
  Coefficients medium;  ///< in any unit of length; the profile is in the same
  ProfileOrders orders = ProfileOrders::kAll;
};

/// Makes profiles for a renderer, the measured ones too: app/ has one (ProfileStore). An empty one stands for
/// the formulas. May take long (Progress), and throws Interrupted.
using ProfileMaker = std::function<std::unique_ptr<Profile>(const ProfileRequest&, const Progress&)>;

/// By `maker`, or, where it is empty, by the formulas; then throws Error (Kind::kUsage) for kTabulated, which
/// no formula gives.
std::unique_ptr<Profile> makeProfile(const ProfileMaker& maker, const ProfileRequest& request,
                                     const Progress& progress = {});

/// A profile by its formula. Throws Error (Kind::kUsage) for kTabulated.
std::unique_ptr<Profile> makeProfile(ProfileKind kind, const Coefficients& coefficients);

/// Rd and P of any profile as a table that fits a texture: `size` entries, entry i at u = (i + .5)/size,
/// r = scale u / (1 - u), values linear in u between entries. Lengths in `unit` mm (a table in object units
/// for the GPU passes unit = object size; Rd is then per unit^2, P has no unit).
class ProfileTable {
 public:
  ProfileTable(const Profile& profile, double unit, int size = 2048);

  int size() const { return int(Rd_.size()); }
  double scale() const { return scale_; }  ///< in units
  const std::vector<glm::vec3>& RdTable() const { return Rd_; }
  const std::vector<glm::vec3>& PTable() const { return P_; }
  glm::vec3 Rd(double r) const { return lookUp(Rd_, r); }  ///< r in units
  glm::vec3 P(double r) const { return lookUp(P_, r); }

 private:
  glm::vec3 lookUp(const std::vector<glm::vec3>& table, double r) const;

  double scale_;
  std::vector<glm::vec3> Rd_, P_;
};

}  // namespace lychnite
