// The golden-angle spiral of the matched sampler: radii that follow the profile's reach, azimuths that fill a circle about
// another centre than the spiral's. Twins: tests/parity.

// Share of the radial importance inside radius r (the receiver's depth under the lit surface included): r / (r + s).
float radialShare(float r, float scale) { return r / (r + scale); }

float radiusOfShare(float share, float scale) { return scale * share / max(1e-6, 1.0 - share); }

// Cosine and sine of the azimuth phi for those of a turn m: even turns, denser towards phi = 0 by (1 + e)/(1 - e), e in [0, 1);
// third, d phi / d m.
vec3 denserAhead(vec2 turn, float e) {
  float squeeze = sqrt(1.0 - e * e);
  float even = 1.0 / (1.0 + e * turn.x);
  return vec3((turn.x + e) * even, squeeze * turn.y * even, squeeze * even);
}

// Distance from a point e0 off the centre of a circle of radius rc to the circle, in the direction with this cosine and
// sine to the centre's.
float distanceToCircle(float e0, float rc, float cosine, float sine) {
  float s = e0 * sine;
  return e0 * cosine + sqrt(max(0.0, rc * rc - s * s));
}
