// What the device can take in at most: every triangle lies off the picture and is dropped after its vertices.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 toClip;

void main() { gl_Position = toClip * vec4(position + 1e-6 * normal, 1.0) + vec4(9.0, 0.0, 0.0, 0.0); }
