// Multiple scattering by the matched sampler: a golden-angle spiral in the light's plane whose radii follow the profile at
// the object's true size; every sample carries exactly the flux of its cell. docs/physics.md, "The matched sampler".
#include "lib/fresnel.glsl"
#include "lib/profile.glsl"
#include "lib/spiral.glsl"
#include "pass/light_view.glsl"
#include "pass/receiver.glsl"
#include "pass/refinement.glsl"

uniform sampler2D moments;    // flux, flux z, flux z^2, flux z^3; z towards the light from centreDepth
uniform sampler2D profile;    // rows from below: Rd, P
uniform float profileScale;
uniform float centreDepth;
uniform float boundRadius;    // of the object's bounding sphere, whose centre the axis passes
uniform float spiralScale;    // half of the samples lie within this distance
uniform float reach;          // beyond it the profile is dark in every channel
uniform int sampleCount;      // cells of the pattern where the surface faces the light

const float kDark = 1e-7;  // a texel with less flux is empty
const float kTexelRadius = 0.5641896;  // of the disc with a texel's area

vec3 profileRd(float r) {
  return textureLod(profile, vec2(profileCoordinate(r, profileScale), 0.25), 0.0).xyz;
}
vec3 profileP(float r) {
  return textureLod(profile, vec2(profileCoordinate(r, profileScale), 0.75), 0.0).xyz;
}

// The receiver in the light's plane, scaled to its own depth.
struct Ground {
  vec2 p;          // scene units from the axis
  vec2 uv;
  float width;     // of the window, scene units
  float texel;
  float z;         // towards the light, of the receiver as the map sees it
  float depth;     // how far the lit surface lies above the receiver; 0 when the receiver is lit
  float window;    // radius of what the map cannot resolve around the receiver: a texel on the slanted surface
  float local;     // flux that enters at the receiver itself, per area of its surface
  float slope2;    // squared slope of the receiver's own surface where it is lit, else 0
  float refinement;  // doublings of the pattern's cells
};

// Height of the lit surface near uv above the plane that is z high there and rises by `slope` along the map's axes: the
// candidate nearest to it among the four texels and their mean.
float surfaceAbove(vec2 uv, float z, vec2 slope, float texel, float fallbackLevels) {
  vec2 size = vec2(textureSize(moments, 0));
  vec2 t = uv * size - 0.5;
  ivec2 base = ivec2(floor(t));
  float best = 1e30;
  for (int i = 0; i < 4; ++i) {
    ivec2 at = clamp(base + ivec2(i & 1, i >> 1), ivec2(0), ivec2(size) - 1);
    vec2 m = texelFetch(moments, at, 0).xy;
    if (m.x < kDark) continue;
    float above = m.y / m.x - z - dot(slope, (vec2(at) - t) * texel);
    if (abs(above) < abs(best)) best = above;
  }
  vec2 mean = textureLod(moments, uv, 0.0).xy;
  if (mean.x > kDark && abs(mean.y / mean.x - z) < abs(best)) best = mean.y / mean.x - z;
  for (float level = 1.0; best > 1e29 && level <= fallbackLevels; level += 1.0) {
    vec2 m = textureLod(moments, uv, level).xy;
    if (m.x > kDark) best = m.y / m.x - z;
  }
  return best > 1e29 ? 0.0 : best;
}

Ground groundOf(LightView view, Receiver r) {
  vec3 m = projectToMap(view, r.position);
  Ground g;
  g.uv = m.xy;
  g.width = 2.0 * view.halfWidth * mix(1.0, m.z, view.perspective);
  g.p = (m.xy - 0.5) * g.width;
  g.texel = g.width / float(textureSize(moments, 0).x);
  g.z = centreDepth - m.z;
  g.slope2 = 0.0;
  float cosI = -dot(r.normal, lightTravel(view, r.position));
  float tan2 = (1.0 - cosI * cosI) / max(0.02, cosI * cosI);
  vec2 across = vec2(dot(r.normal, view.right), dot(r.normal, view.up));
  vec2 slope = cosI > 0.0 ? -across / max(0.14, cosI) : vec2(0.0);
  float above = surfaceAbove(m.xy, g.z, slope, g.texel, log2(float(textureSize(moments, 0).x)));
  // Lit: put the receiver onto the surface that the map holds, which leaves the receiver's plane by its bend only. Faded,
  // so that the edge of a shadow does not follow the texels.
  float slack = 0.25 * g.texel * (1.0 + sqrt(tan2));
  float lit = cosI > 0.0 ? 1.0 - smoothstep(0.5 * slack, 2.0 * slack, abs(above)) : 0.0;
  g.z += lit * above;
  g.slope2 = lit * tan2;
  g.refinement = refinementOf(cosI);
  g.depth = (1.0 - lit) * above;
  g.window = kTexelRadius * g.texel * mix(1.0, sqrt(1.0 + tan2), lit);
  g.local = lit * max(cosI, 0.0) * textureLod(moments, m.xy, 0.0).x;
  return g;
}

struct Sum {
  vec3 radiosity;
  vec3 weighted;      // sum of A^2 F f, for the control variate
  float weight;       // sum of A^2 F
  float flux;         // sum of A F
  vec3 faintest;      // smallest kernel among the outermost quarter
};

// One sample: a piece of the ring from a to b around the receiver's projection.
struct Cell {
  vec2 uv;
  float a, q, b;   // radii: inner, of the sample, outer
  float area;      // scene units, across the light
};

// From this one on, and at its end, the rings of a spiral take one fetch of the kernel.
int firstNarrow(float cells) { return min(10, int(cells) - 1); }

// Mean of the kernel over the ring between two squared distances: of a spiral's inner rings, which are wide, by P; of the
// outer ones, where P's digits would cancel, at the distances' geometric mean. That is exact where the kernel falls as their
// fourth power or not at all; between the two it is off by less than 1/24 of the squared logarithm of a2 / b2, and where it
// falls faster there is little left of it.
vec3 kernelMean(float a2, float b2, bool narrow) {
  if (narrow) return profileRd(sqrt(sqrt(a2 * b2)));
  float most = max(a2, b2);
  float least = min(min(a2, b2), 0.98 * most);
  return (profileP(sqrt(least)) - profileP(sqrt(most))) / (3.141592653589793 * (most - least));
}

// Kernel of one cell whose flux sits at height `height` above the receiver at the cell's middle radius q. Distances are
// rounded off by the window: what that takes away near the receiver, it answers for itself.
vec3 cellKernel(Cell c, bool narrow, float start, float height, float window) {
  float ha = start + (height - start) * c.a / c.q;
  float hb = start + (height - start) * c.b / c.q;
  float a2 = c.a * c.a + ha * ha + window * window;
  float b2 = c.b * c.b + hb * hb + window * window;
  return kernelMean(a2, b2, narrow);
}

// The receiver's spiral: it fills the object's circle, which lies off the receiver by e0.
struct Spiral {
  float d;         // least distance of lit surface, which may be nearer than straight above
  float g0;        // radial share inside d
  float e0;        // receiver to the circle's centre
  float rc;        // radius of the circle
  float farthest;
  vec2 inwards;    // unit, towards the circle's centre
  float inwardsTurn;
  float e;         // eccentricity of the azimuths
};

Spiral spiralOf(Ground g) {
  Spiral s;
  s.d = min(0.2 * max(g.depth, 0.0), 0.5 * spiralScale);
  s.g0 = radialShare(s.d, spiralScale);
  s.rc = 1.05 * boundRadius + g.texel;
  s.e0 = min(length(g.p), 0.999 * s.rc);
  s.inwards = s.e0 > 1e-6 ? -g.p / length(g.p) : vec2(1.0, 0.0);
  s.farthest = length(vec2(reach, s.d));
  float farShare = radialShare(min(length(vec2(s.rc + s.e0, s.d)), s.farthest), spiralScale) - s.g0;
  float nearShare = radialShare(min(length(vec2(s.rc - s.e0, s.d)), s.farthest), spiralScale) - s.g0;
  // Cells ahead, behind and beside are wanted as 1 + e, 1 - e and 1 are to each other; e / (1 + e) gives that ahead and beside.
  float e = 0.9 * (farShare - nearShare) / max(1e-9, farShare + nearShare);
  s.e = e / (1.0 + e);
  // The golden angle's turns are the map's own, not counted from `inwards`: the pattern would spin where the receiver
  // crosses the axis.
  s.inwardsTurn = atan(s.inwards.y, s.inwards.x) / 6.283185307179586;
  return s;
}

// Cosine and sine of a sample's turn before it is made denser, from behind, so that the largest cells, the first, do not all
// lie ahead.
vec2 turnOf(Spiral s, int index) {
  float turn = 6.283185307179586 * (fract(0.6180339887498949 * float(index) - s.inwardsTurn) - 0.5);
  return vec2(cos(turn), sin(turn));
}

// The next sample's turn: the golden angle further.
vec2 nextTurn(vec2 turn) {
  const vec2 kGolden = vec2(-0.7373688780783197, -0.6754902942615238);
  return vec2(turn.x * kGolden.x - turn.y * kGolden.y, turn.y * kGolden.x + turn.x * kGolden.y);
}

Cell cellOf(Ground g, Spiral s, float cells, int index, vec2 turn) {
  float i = float(index);
  vec3 phi = denserAhead(turn, s.e);
  float edge = min(length(vec2(distanceToCircle(s.e0, s.rc, phi.x, phi.y), s.d)), s.farthest);
  float share = radialShare(edge, spiralScale) - s.g0;
  vec3 at = vec3(i, i + 0.5, i + 1.0) * (share / cells) + s.g0;
  float ra = radiusOfShare(at.x, spiralScale);
  float rq = radiusOfShare(at.y, spiralScale);
  float rb = radiusOfShare(at.z, spiralScale);
  Cell c;
  c.a = index == 0 ? 0.0 : sqrt(max(0.0, ra * ra - s.d * s.d));
  c.q = sqrt(max(1e-16, rq * rq - s.d * s.d));
  c.b = sqrt(max(1e-16, rb * rb - s.d * s.d));
  c.area = 3.141592653589793 * (c.b * c.b - c.a * c.a) * phi.z;
  c.uv = g.uv + c.q * (phi.x * s.inwards + phi.y * vec2(-s.inwards.y, s.inwards.x)) / g.width;
  return c;
}

float levelOf(Ground g, Cell c) { return max(0.0, 0.5 * log2(c.area) - log2(g.texel) - 1.0); }

// A spread of depths below this share of the distance, both squared, is none.
const float kNoSpread = 0.003;

void addCell(inout Sum sum, Ground g, Cell c, bool narrow, bool outermost) {
  float level = levelOf(g, c);
  vec4 t = textureLod(moments, c.uv, level);
  if (t.x < kDark) return;
  vec3 m = t.yzw / t.x;
  float variance = m.y - m.x * m.x;
  float height = m.x - g.z;
  // The surface's slope inside the footprint is not a spread of depths.
  float footprint = max(g.texel, 0.5 * sqrt(c.area));
  float slope2 = max((height - g.depth) * (height - g.depth) / (c.q * c.q), g.slope2);
  variance -= 0.25 * slope2 * footprint * footprint;
  // Two nodes with the flux's mean, variance and skewness; without a spread they are one.
  bool spread = variance > max(1e-9, kNoSpread * (c.q * c.q + height * height));
  float third = m.z - 3.0 * m.x * m.y + 2.0 * m.x * m.x * m.x;
  float deviation = spread ? sqrt(variance) : 0.0;
  float skew = spread ? clamp(third / (variance * deviation), -20.0, 20.0) : 0.0;
  float root = sqrt(skew * skew + 4.0);
  float w = spread ? 0.5 * (skew + root) / root : 1.0;
  vec3 f = w * cellKernel(c, narrow, g.depth, height + 0.5 * deviation * (skew - root), g.window);
  if (spread) f += (1.0 - w) * cellKernel(c, narrow, g.depth, height + 0.5 * deviation * (skew + root), g.window);
  sum.radiosity += c.area * t.x * f;
  sum.weighted += c.area * c.area * t.x * f;
  sum.weight += c.area * c.area * t.x;
  sum.flux += c.area * t.x;
  if (outermost) sum.faintest = min(sum.faintest, f);
}

// The map is dark beyond its border, and its coarse levels fade there.
vec3 patternRadiosity(Ground g, Spiral s, float cells) {
  Sum sum = Sum(vec3(0.0), vec3(0.0), 0.0, 0.0, vec3(1e30));
  vec2 turn = turnOf(s, 0);
  // Loops that end with their condition: a software driver runs the whole body before it sees that nobody is left in it.
  int i = 0;
  do {
    addCell(sum, g, cellOf(g, s, cells, i, turn), false, 4.0 * float(i) >= 3.0 * cells);
    turn = nextTurn(turn);
  } while (++i < firstNarrow(cells));
  do {
    addCell(sum, g, cellOf(g, s, cells, i, turn), true, 4.0 * float(i) >= 3.0 * cells);
    turn = nextTurn(turn);
  } while (float(++i) < cells);
  // What the samples missed of the known total flux, spread like the samples (a control variate), tapered where they
  // missed so much that the estimate means nothing.
  float total = textureLod(moments, vec2(0.5), 30.0).x * g.width * g.width;
  float missed = total - sum.flux;
  float share = missed / max(1e-9, 0.4 * total);
  float taper = max(0.0, 1.0 - share * share);
  vec3 beta = min(sum.weighted / max(1e-20, sum.weight), 1.5 * sum.faintest);
  return max(vec3(0.0), sum.radiosity + beta * (taper * missed));
}

vec3 radiosity(LightView view, Receiver r) {
  Ground g = groundOf(view, r);
  Spiral s = spiralOf(g);
  // From one number of cells to twice as many by a cross-fade: a pattern that grew cell by cell would show as rings.
  float coarse = floor(g.refinement);
  float finer = finerWeight(g.refinement);
  vec3 sum = vec3(0.0);
  int i = 0;
  do {
    sum += (i == 0 ? 1.0 - finer : finer) * patternRadiosity(g, s, float(sampleCount) * exp2(coarse + float(i)));
  } while (++i < (finer > 0.0 ? 2 : 1));
  return sum + (profileP(0.0) - profileP(g.window)) * g.local;
}

// Power of the light at the receiver's depth, per flux of the map.
vec3 powerAt(LightView view, Receiver r) {
  float depth = dot(r.position - view.origin, view.forward);
  return lightPower / mix(1.0, depth * depth, view.perspective);
}

// What leaves the surface at the receiver for the light as it is.
vec3 litRadiosity(LightView view, Receiver r) { return powerAt(view, r) * radiosity(view, r); }
