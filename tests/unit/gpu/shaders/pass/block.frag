layout(std140) uniform Numbers { vec4 numbers[2]; };
layout(location = 0) out vec4 colour;

void main() { colour = numbers[0] + numbers[1]; }
