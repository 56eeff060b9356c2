// What the device can write at most.
uniform vec4 value;
layout(location = 0) out vec4 colour;

void main() { colour = value; }
