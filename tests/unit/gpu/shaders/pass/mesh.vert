layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform vec3 offset;
out vec3 surfaceNormal;

void main() {
  surfaceNormal = normal;
  gl_Position = vec4(position + offset, 1.0);
}
