// Doublings of the matched sampler's cells where the surface slants, and where two patterns are cross-faded.

// Seen from the light, what is near on a slanted surface is a strip cosI times as narrow as it is long: the round pattern needs
// 1 / cosI as many cells for it.
float refinementOf(float cosI) { return clamp(-log2(max(abs(cosI), 1e-3)), 0.0, float(MOST_REFINEMENT)); }

// Weight of the pattern of twice as many cells.
const float kFadeFrom = 0.75;
float finerWeight(float refinement) { return smoothstep(kFadeFrom, 1.0, fract(refinement)); }
