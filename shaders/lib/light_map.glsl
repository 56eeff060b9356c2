// The light-space map's view: orthographic for parallel light, perspective for a point. Lengths in scene units.
// Twin: technique/light_map/light_view.h.

struct LightView {
  vec3 origin;        // orthographic: where depth is 0 on the axis; perspective: the light
  vec3 right;         // unit
  vec3 up;            // unit
  vec3 forward;       // unit, the way the light travels along the axis
  float halfWidth;    // orthographic: half the window; perspective: tangent of half its angle
  float perspective;  // 0 or 1
};

// (u, v) in [0, 1] over the window and the depth along the axis.
vec3 projectToMap(LightView view, vec3 p) {
  vec3 d = p - view.origin;
  float depth = dot(d, view.forward);
  float scale = 0.5 / (view.halfWidth * mix(1.0, depth, view.perspective));
  return vec3(dot(d, view.right) * scale + 0.5, dot(d, view.up) * scale + 0.5, depth);
}

vec3 unprojectFromMap(LightView view, vec2 uv, float depth) {
  float scale = 2.0 * view.halfWidth * mix(1.0, depth, view.perspective);
  return view.origin + view.right * ((uv.x - 0.5) * scale) + view.up * ((uv.y - 0.5) * scale) + view.forward * depth;
}

// Unit direction in which light travels through p.
vec3 lightTravel(LightView view, vec3 p) {
  return view.perspective > 0.5 ? normalize(p - view.origin) : view.forward;
}

// Irradiance on a surface facing the light at p: E0, or intensity over the squared distance.
vec3 facingIrradiance(LightView view, vec3 power, vec3 p) {
  if (view.perspective < 0.5) return power;
  vec3 d = p - view.origin;
  return power / dot(d, d);
}

// Area across the light of the map's window at `depth`, seen along the ray through p there.
float windowArea(LightView view, vec3 p, float depth) {
  float side = 2.0 * view.halfWidth * mix(1.0, depth, view.perspective);
  return side * side * dot(lightTravel(view, p), view.forward);
}

// Distance along the light's ray between two depths on it.
float depthToDistance(LightView view, vec3 p, float depthDifference) {
  return depthDifference / dot(lightTravel(view, p), view.forward);
}
