layout(location = 0) out vec4 colour;
#include "lib/twice.glsl"

void main() { colour = thrice(vec4(1.0)); }
