// What the device can fetch at most: FETCHES reads a pixel from neighbouring places, as the scattering passes do, and as
// little else as keeps the compiler from leaving them out.
uniform sampler2D map;
uniform float level;

layout(location = 0) out vec4 sum;

void main() {
  vec2 size = vec2(textureSize(map, 0));
  vec2 place = fract(gl_FragCoord.xy / 600.0);
  vec4 s = vec4(0.0);
  for (int i = 0; i < FETCHES; ++i) {
    vec2 at = fract(place + vec2(float(i % 7), float(i / 7)) * 0.031);
#if KIND == 0
    s += texelFetch(map, ivec2(at * size), 0);
#else
    s += textureLod(map, at, level);
#endif
  }
  sum = s;
}
