// The surface points of a pixel at which scattering is evaluated. The geometry texture holds 2 x 2 samples a pixel;
// where all four lie on one smooth piece of surface they become one receiver, elsewhere (silhouettes, creases, where
// the exit lobe falls off) each is its own, so that edges are anti-aliased and what is inside them is not blurred.
#include "lib/octahedral.glsl"

uniform sampler2D geometry;
uniform vec3 cameraPosition;
uniform vec3 cameraRight;    // times the tangent of half the horizontal angle
uniform vec3 cameraUp;       // times the tangent of half the vertical angle
uniform vec3 cameraForward;
uniform float objectNumber;
uniform float shareWithin;   // samples this near on one smooth piece share a receiver though their exit lobes differ

// Cosines to the camera so close together, the less the flatter, have one exit lobe. As reference/camera_receivers.cpp.
const float kLobeSpread = 0.25;

struct Receiver {
  vec3 position;  // scene units
  vec3 normal;
  vec3 view;      // towards the camera
  vec4 cosO;      // of its samples; the last one's again where there are fewer than four
  float weight;   // share of the pixel
};

vec3 rayThrough(vec2 sampleCoordinate) {
  vec2 ndc = sampleCoordinate / vec2(textureSize(geometry, 0)) * 2.0 - 1.0;
  return cameraForward + cameraRight * ndc.x + cameraUp * ndc.y;
}

Receiver receiverAt(vec3 position, vec3 normal, float weight) {
  vec3 view = normalize(cameraPosition - position);
  return Receiver(position, normal, view, vec4(clamp(dot(normal, view), 0.0, 1.0)), weight);
}

// One receiver for `count` samples, if they are one smooth piece: normals within about 25 degrees, points near one plane in
// terms of their own spread; and of one exit lobe, or near together.
bool together(vec3 positions[4], vec3 normals[4], int count, out Receiver receiver) {
  vec3 centre = vec3(0.0);
  vec3 normal = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    centre += positions[i];
    normal += normals[i];
  }
  centre /= float(count);
  float agreement = length(normal) / float(count);
  normal = normalize(normal);
  // The diagonals of four.
  int last = count - 1;
  float spread = max(distance(positions[0], positions[last]), distance(positions[1], positions[min(2, last)]));
  receiver = receiverAt(centre, normal, 0.25 * float(count));
  float off = 0.0;
  float least = 1.0;
  float most = 0.0;
  for (int i = 0; i < 4; ++i) {
    int j = min(i, last);
    off = max(off, abs(dot(positions[j] - centre, normal)));
    receiver.cosO[i] = dot(normals[j], normalize(cameraPosition - positions[j]));
    least = min(least, receiver.cosO[i]);
    most = max(most, receiver.cosO[i]);
  }
  bool oneLobe = count == 4 && most - least < kLobeSpread * least * least;
  receiver.cosO = oneLobe ? vec4(dot(normal, receiver.view)) : receiver.cosO;
  receiver.cosO = clamp(receiver.cosO, 0.0, 1.0);
  return agreement > 0.975 && off < 0.25 * spread && (oneLobe || spread < shareWithin);
}

// Receivers of this object among the 2 x 2 samples from `first` on, 0 to 4.
int loadReceivers(ivec2 first, out Receiver receivers[4]) {
  vec3 positions[4];
  vec3 normals[4];
  int count = 0;
  for (int i = 0; i < 4; ++i) {
    ivec2 texel = first + ivec2(i & 1, i >> 1);
    vec4 g = texelFetch(geometry, texel, 0);
    if (g.w != objectNumber) continue;
    positions[count] = cameraPosition + rayThrough(vec2(texel) + 0.5) * g.x;
    normals[count] = octDecode(g.yz);
    ++count;
  }
  if (count > 1 && together(positions, normals, count, receivers[0])) return 1;
  for (int i = 0; i < 4; ++i)
    if (i < count) receivers[i] = receiverAt(positions[i], normals[i], 0.25);
  return count;
}
