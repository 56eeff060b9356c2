#include "lychnite/optics/coefficients.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

/// Channel by channel a / b, `empty` where b is 0.
Rgb ratio(const Rgb& a, const Rgb& b, double empty) {
  Rgb result;
  for (int c = 0; c < 3; ++c) result[c] = b[c] > 0 ? a[c] / b[c] : empty;
  return result;
}

[[noreturn]] void refuse(std::string_view where, std::string_view name, std::string expected,
                         std::string found) {
  throw Error({.where = where.empty() ? std::string(name) : fmt::format("{}: {}", where, name),
               .expected = std::move(expected),
               .found = std::move(found),
               .todo = ""},
              Error::Kind::kUsage);
}

}  // namespace

Rgb Coefficients::albedo_p() const {
  return ratio(sigma_sp(), sigma_tp(), 0);
}
Rgb Coefficients::albedo() const {
  return ratio(sigma_s, sigma_t(), 0);
}
Rgb Coefficients::sigma_tr() const {
  const Rgb product = 3.0 * sigma_a * sigma_tp();
  return {std::sqrt(product.x), std::sqrt(product.y), std::sqrt(product.z)};
}
Rgb Coefficients::mean_free_path() const {
  return ratio(Rgb(1), sigma_t(), std::numeric_limits<double>::infinity());
}

Coefficients Coefficients::scaled(double s) const {
  Coefficients result = *this;
  result.sigma_s /= s;
  result.sigma_a /= s;
  return result;
}

void validate(const Coefficients& coefficients, std::string_view where) {
  const auto check = [&](const Rgb& sigma, std::string_view name) {
    for (int c = 0; c < 3; ++c)
      if (!(sigma[c] >= 0) || !std::isfinite(sigma[c]))
        refuse(where, name, "three finite coefficients of 0/mm or more", fmt::format("{}", sigma[c]));
  };
  check(coefficients.sigma_s, "sigma_s");
  check(coefficients.sigma_a, "sigma_a");
  if (!(std::abs(coefficients.g) < 1))
    refuse(where, "g", "a mean cosine between -1 and 1, both excluded", fmt::format("{}", coefficients.g));
  if (!(coefficients.eta >= 1 && coefficients.eta <= 4))
    refuse(where, "eta",
           "a refractive index from 1 to 4 (inside over outside; a translucent solid is never thinner "
           "than the air around it)",
           fmt::format("{}", coefficients.eta));
}

Rgb albedoFromColour(const Rgb& colour, double g) {
  Rgb alpha;
  for (int c = 0; c < 3; ++c) {
    const double a = colour[c];
    const double s = 4.09712 + 4.20863 * a - std::sqrt(9.59217 + 41.6808 * a + 17.7126 * a * a);
    alpha[c] = (1 - s * s) / (1 - g * s * s);
  }
  return alpha;
}

Coefficients coefficientsFromColour(const Rgb& colour, const Rgb& mean_free_path, double g, double eta) {
  const Rgb alpha = albedoFromColour(colour, g);
  const Rgb sigma_t = 1.0 / mean_free_path;
  return {.sigma_s = alpha * sigma_t, .sigma_a = (1.0 - alpha) * sigma_t, .g = g, .eta = eta};
}

}  // namespace lychnite
