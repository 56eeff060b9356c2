// Depth of the surface farthest from the light: where the inside ends for single scattering.
#include "pass/light_view.glsl"

in vec3 worldPosition;
in vec3 worldNormal;
layout(location = 0) out float mapDepth;

void main() {
  // worldNormal is part of the vertex stage's interface only.
  mapDepth = dot(worldPosition - viewOrigin, viewForward);
}
