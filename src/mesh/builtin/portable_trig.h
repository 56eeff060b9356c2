#pragma once

#include <cmath>

namespace lychnite::builtin {

/// A point of the unit circle. The C library's sin and cos may differ in the last bit from one machine to the
/// next; these use only operations IEEE 754 rounds one way, and are exact at quarter turns.
struct CirclePoint {
  double cos = 1, sin = 0;
};

/// The point at `turns` full turns (any finite number); the series is cut where its error is below 1e-16.
inline CirclePoint circlePoint(double turns) {
  const double t = turns - std::floor(turns);
  const int quarter = static_cast<int>(4 * t + 0.5);
  const double a = (t - 0.25 * quarter) * 6.283185307179586;
  double sine = 0, cosine = 0, term = 1;
  for (int n = 1; n <= 18; n += 2) {
    cosine += term;
    term *= a / n;
    sine += term;
    term *= -a / (n + 1);
  }
  switch (quarter % 4) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace lychnite::builtin
