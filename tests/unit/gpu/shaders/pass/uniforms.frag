// The sum of everything Program can set, each in its own decimal place.
uniform int i;
uniform uint u;
uniform float f;
uniform bool b;
uniform ivec2 i2;
uniform vec2 v2;
uniform vec3 v3;
uniform vec4 v4;
uniform mat3 m3;
uniform mat4 m4;
uniform float fs[2];
uniform vec2 v2s[2];
uniform vec3 v3s[2];
uniform vec4 v4s[2];
layout(location = 0) out vec4 scalars;
layout(location = 1) out vec4 vectors;
layout(location = 2) out vec4 matrices;
layout(location = 3) out vec4 arrays;

void main() {
  scalars = vec4(float(i), float(u), f, b ? 1.0 : 0.0);
  vectors = vec4(float(i2.y), v2.y, v3.z, v4.w);
  matrices = vec4(m3[2][0], m3[0][2], m4[3][0], m4[0][3]);
  arrays = vec4(fs[1], v2s[1].y, v3s[1].z, v4s[1].w);
}
