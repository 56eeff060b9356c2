// The samples that multiple_lattice.frag takes for one pixel.
#include "pass/lattice_sampler.glsl"
#include "pass/seen_samples.glsl"

void main() {
  Receivers all = loadReceivers(pixel * 2);
  place = vec4(0.0);
  share = vec4(0.0);
  if (all.count == 0) return;
  LightView view = lightView();
  Receiver r = all.first;
  int i = int(gl_FragCoord.x);
  if (i == kCells) {
    place = vec4(r.position, float(all.count));
    share = vec4(radiosity(view, r.position), 0.0);
    return;
  }
  Cell c = cellOf(view, r.position, vec2(projectToMap(view, r.position)), i);
  place = vec4(c.uv, c.level, sqrt(lattice[i].w) / float(textureSize(map, 0).x));
  share = vec4(c.radiosity, c.depth);
}
