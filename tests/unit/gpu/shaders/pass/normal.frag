in vec3 surfaceNormal;
layout(location = 0) out vec4 colour;

void main() { colour = vec4(surfaceNormal, gl_FragCoord.z); }
