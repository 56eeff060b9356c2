// The samples that the matched sampler takes for one pixel, were it evaluated for itself.
#include "pass/matched_sampler.glsl"
#include "pass/seen_samples.glsl"

void main() {
  Receivers all = loadReceivers(pixel * 2);
  place = vec4(0.0);
  share = vec4(0.0);
  if (all.count == 0) return;
  LightView view = lightView();
  Receiver r = all.first;
  int i = int(gl_FragCoord.x);
  if (i == sampleCount << MOST_REFINEMENT) {
    place = vec4(r.position, float(all.count));
    share = vec4(litRadiosity(view, r), 0.0);
    return;
  }
  Ground g = groundOf(view, r);
  float cells = float(sampleCount) * exp2(floor(g.refinement + 0.125));  // of the pattern that has more of the weight
  if (float(i) >= cells) return;
  Spiral s = spiralOf(g);
  Cell c = cellOf(g, s, cells, i, turnOf(s, i));
  float level = levelOf(g, c);
  place = vec4(c.uv, level, sqrt(c.area) / g.width);
  Sum sum = Sum(vec3(0.0), vec3(0.0), 0.0, 0.0, vec3(1e30));
  addCell(sum, g, c, i >= firstNarrow(cells), false);
  vec2 m = textureLod(moments, c.uv, level).xy;
  share = vec4(powerAt(view, r) * sum.radiosity, m.x > kDark ? centreDepth - m.y / m.x : 0.0);
}
