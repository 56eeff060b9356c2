// The golden-angle spiral of the matched sampler: radii that follow the profile's reach, azimuths that fill a circle about
// another centre than the spiral's. Twin: technique/multiple/spiral.h; derivation in docs/physics.md.

// Share of the radial importance inside radius r (the receiver's depth under the lit surface included): r / (r + s).
float radialShare(float r, float scale) { return r / (r + scale); }

float radiusOfShare(float share, float scale) { return scale * share / max(1e-6, 1.0 - share); }

// Solves phi + e sin(phi) = m for phi, m in [-pi, pi], |e| <= 0.9: azimuths whose density is (1 + e cos(phi)) / 2 pi.
// Newton's method, begun at m.
float warpedAzimuth(float m, float e) {
  float phi = m;
  for (int i = 0; i < 4; ++i) phi -= (phi + e * sin(phi) - m) / (1.0 + e * cos(phi));
  return phi;
}

// Distance from a point e0 off the centre of a circle of radius rc to the circle, at azimuth phi from the direction to
// the centre.
float distanceToCircle(float e0, float rc, float phi) {
  float s = e0 * sin(phi);
  return e0 * cos(phi) + sqrt(max(0.0, rc * rc - s * s));
}
