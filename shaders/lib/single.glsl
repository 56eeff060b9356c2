// Single scattering. [J01] sect. 2.1, Yao & Wang 2009 eq. 11; docs/physics.md derives the factors.

// Straight distance s inside under a surface met at cosI, turned into the refracted ray's ([J01] sect. 2.1).
float refractedDistance(float s, float cosI, float eta) { return s * cosI / max(1e-4, refractedCosine(cosI, eta)); }

// Distance of stratum u in (0, 1) under the exponential of rate sigma, cut off at `end`.
float freePath(float u, float sigma, float end) {
  float span = 1.0 - exp(-sigma * end);
  if (sigma * end < 1e-4) return u * end;
  return -log(1.0 - u * span) / sigma;
}

// Its density.
float freePathDensity(float s, float sigma, float end) {
  if (sigma * end < 1e-4) return 1.0 / end;
  return sigma * exp(-sigma * s) / (1.0 - exp(-sigma * end));
}

// Distance along the unit ray o + t d to where it leaves the sphere; 0 when it misses.
float leaveSphere(vec3 o, vec3 d, vec3 centre, float radius) {
  vec3 m = o - centre;
  float b = dot(m, d);
  float disc = b * b - dot(m, m) + radius * radius;
  return disc <= 0.0 ? 0.0 : max(0.0, sqrt(disc) - b);
}
