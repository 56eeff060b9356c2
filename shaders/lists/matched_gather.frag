// Multiple scattering by the matched sampler, last part: a pixel's evaluated receivers.
uniform sampler2D listed;     // as matched_plan.frag wrote it
uniform sampler2D evaluated;  // as matched_evaluate.comp did
uniform int firstRow;

layout(location = 0) out vec4 radiance;

void main() {
  ivec2 site = ivec2(gl_FragCoord.xy);
  int left = int(texelFetch(listed, site, 0).x);
  if (left == 0) discard;
  vec3 sum = vec3(0.0);
  int row = (site.y - firstRow) * 4;
  do {
    if ((left & 1) == 1) sum += texelFetch(evaluated, ivec2(site.x, row), 0).xyz;
    left >>= 1;
    ++row;
  } while (left > 0);
  radiance = vec4(sum, 0.0);
}
