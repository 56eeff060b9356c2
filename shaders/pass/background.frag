// Coverage of the pixel by any object, and what shows through.
uniform sampler2D geometry;
uniform vec3 background;

layout(location = 0) out vec4 colour;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy) * 2;
  float covered = 0.0;
  for (int i = 0; i < 4; ++i)
    if (texelFetch(geometry, first + ivec2(i & 1, i >> 1), 0).w > 0.0) covered += 0.25;
  colour = vec4(background * (1.0 - covered), covered);
}
