layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

uniform mat4 toWorld;        // mesh to scene units
uniform mat4 toClip;         // mesh to clip space
uniform mat3 normalToWorld;

out vec3 worldPosition;
out vec3 worldNormal;

void main() {
  worldPosition = (toWorld * vec4(position, 1.0)).xyz;
  worldNormal = normalToWorld * normal;
  gl_Position = toClip * vec4(position, 1.0);
}
