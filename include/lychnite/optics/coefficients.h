#pragma once

#include <string_view>

#include "lychnite/base/vec.h"

namespace lychnite {

/// What a translucent medium is: the only optical input of every method. Coefficients in 1/mm, linear RGB.
struct Coefficients {
  Rgb sigma_s{0};    ///< scattering, >= 0
  Rgb sigma_a{0};    ///< absorption, >= 0
  double g = 0;      ///< mean cosine of the Henyey-Greenstein phase function, in (-1, 1)
  double eta = 1.3;  ///< refractive index, inside over outside, in [1, 4]

  Rgb sigma_t() const { return sigma_s + sigma_a; }
  Rgb sigma_sp() const { return sigma_s * (1.0 - g); }
  Rgb sigma_tp() const { return sigma_sp() + sigma_a; }
  /// Reduced albedo sigma_sp / sigma_tp; 0 where the medium is empty.
  Rgb albedo_p() const;
  /// Single-scattering albedo sigma_s / sigma_t; 0 where the medium is empty.
  Rgb albedo() const;
  /// Effective transport coefficient sqrt(3 sigma_a sigma_tp) [J01 sect. 2.2].
  Rgb sigma_tr() const;
  /// 1 / sigma_t in mm; infinite where the medium is empty.
  Rgb mean_free_path() const;

  /// The same medium in a world scaled by `s` (lengths times s, coefficients over s).
  Coefficients scaled(double s) const;

  bool operator==(const Coefficients&) const = default;
};

/// Throws Error (Kind::kUsage, prefix `where`) for negative, NaN or infinite coefficients, g outside (-1, 1),
/// eta outside [1, 4] (with the reason: eta is inside over outside, and nothing here is an air bubble in
/// glass).
void validate(const Coefficients& coefficients, std::string_view where);

/// Colour to coefficients: the reduced single-scattering albedo alpha whose half-space has diffuse albedo
/// `colour` (each channel in [0, 1)) at asymmetry g. Van de Hulst as fitted by Kulla & Conty 2017: s
/// = 4.09712 + 4.20863 A - sqrt(9.59217 + 41.6808 A + 17.7126 A^2), alpha = (1 - s^2)/(1 - g s^2).
Rgb albedoFromColour(const Rgb& colour, double g);

/// Coefficients from a diffuse colour and a mean free path (mm, per channel, > 0).
Coefficients coefficientsFromColour(const Rgb& colour, const Rgb& mean_free_path, double g, double eta);

}  // namespace lychnite
