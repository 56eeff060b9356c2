layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

uniform mat4 toClip;         // mesh to clip space
uniform mat3 normalToWorld;

out vec3 worldNormal;

void main() {
  worldNormal = normalToWorld * normal;
  gl_Position = toClip * vec4(position, 1.0);
}
