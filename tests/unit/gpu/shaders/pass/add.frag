#include "lib/twice.glsl"
#include "lib/twice.glsl"
uniform vec4 amount;
layout(location = 0) out vec4 colour;

void main() { colour = twice(amount) * SCALE; }
