// Dielectric interface. Twin: optics/fresnel.h.

// Exact unpolarised reflectance; cosI in [0, 1] on the near side, eta = far over near index.
float fresnelReflectance(float cosI, float eta) {
  if (eta == 1.0) return 0.0;  // what follows would call grazing light totally reflected
  float sin2T = (1.0 - cosI * cosI) / (eta * eta);
  if (sin2T >= 1.0) return 1.0;
  float cosT = sqrt(1.0 - sin2T);
  float parallel = (eta * cosI - cosT) / (eta * cosI + cosT);
  float perpendicular = (cosI - eta * cosT) / (cosI + eta * cosT);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

// S_w of leaving light, 1/sr: Ft / (pi C(eta)); piC = pi C(eta) comes from the CPU.
float exitLobe(float cosO, float eta, float piC) { return (1.0 - fresnelReflectance(cosO, eta)) / piC; }

// Cosine inside of a ray that meets the outside of the surface at cosI.
float refractedCosine(float cosI, float eta) { return sqrt(max(0.0, 1.0 - (1.0 - cosI * cosI) / (eta * eta))); }

// Direction of travel inside for a direction of travel d outside, n against d, both unit; eta >= 1, so it always exists.
vec3 refractInto(vec3 d, vec3 n, float eta) {
  float cosI = -dot(d, n);
  return normalize(d * (1.0 / eta) + n * (cosI / eta - refractedCosine(cosI, eta)));
}
