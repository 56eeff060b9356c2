// Henyey & Greenstein 1941, 1/sr. Twin: optics/phase.h.
float henyeyGreenstein(float cosTheta, float g) {
  float d = max(1e-6, 1.0 + g * g - 2.0 * g * cosTheta);
  return (1.0 - g * g) / (12.566370614359172 * d * sqrt(d));
}
