// Multiple scattering by the matched sampler, last part: a pixel's interpolated and evaluated receivers.
uniform sampler2D value;      // as matched_plan.frag wrote them
uniform sampler2D surface;
uniform sampler2D evaluated;  // as matched_evaluate.comp did
uniform int firstRow;

layout(location = 0) out vec4 radiance;

void main() {
  ivec2 site = ivec2(gl_FragCoord.xy) - ivec2(0, firstRow);
  vec3 sum = texelFetch(value, site, 0).xyz;
  int listed = int(texelFetch(surface, site, 0).w) - 1;
  for (int i = 0; i < 4 && listed > 0; ++i, listed >>= 1)
    if ((listed & 1) == 1) sum += texelFetch(evaluated, ivec2(site.x, site.y * 4 + i), 0).xyz;
  radiance = vec4(sum, 0.0);
}
