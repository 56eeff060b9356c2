// Single scattering. [J01] sect. 2.1, Yao & Wang 2009 eq. 11; docs/physics.md derives the factors.

// Straight distance s inside under a surface met at cosI, turned into the refracted ray's ([J01] sect. 2.1).
float refractedDistance(float s, float cosI, float eta) { return s * cosI / max(1e-4, refractedCosine(cosI, eta)); }

// Distance of stratum u in (0, 1) under the exponential of rate sigma, cut off at `end`. In a thin medium, where the
// exponential's digits cancel, by its series (4e-6 of `end` at the seam).
float freePath(float u, float sigma, float end) {
  float x = sigma * end;
  if (x < 0.01) return u * end * (1.0 - 0.5 * x * (1.0 - u));
  return -log(1.0 - u * (1.0 - exp(-x))) / sigma;
}

// Its density.
float freePathDensity(float s, float sigma, float end) {
  float x = sigma * end;
  if (x < 0.01) return (1.0 + 0.5 * x - sigma * s) / end;
  return sigma * exp(-sigma * s) / (1.0 - exp(-x));
}

// Distance along the unit ray o + t d to where it leaves the sphere; 0 when it misses.
float leaveSphere(vec3 o, vec3 d, vec3 centre, float radius) {
  vec3 m = o - centre;
  float b = dot(m, d);
  float disc = b * b - dot(m, m) + radius * radius;
  return disc <= 0.0 ? 0.0 : max(0.0, sqrt(disc) - b);
}
