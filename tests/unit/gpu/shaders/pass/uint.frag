uniform uint base;
layout(location = 0) out uint result;

void main() { result = base + uint(gl_FragCoord.x); }
