#include "lib/twice.glsl"
#include "lib/broken.glsl"
layout(location = 0) out vec4 colour;

void main() { colour = twice(vec4(broken(1.0))); }
