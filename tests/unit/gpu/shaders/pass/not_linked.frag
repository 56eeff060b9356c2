in vec4 neverWritten;
layout(location = 0) out vec4 colour;

void main() { colour = neverWritten; }
