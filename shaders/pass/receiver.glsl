// The surface points of a pixel at which scattering is evaluated. The geometry texture holds 2 x 2 samples a pixel;
// where all four lie on one smooth piece of surface they become one receiver, elsewhere (silhouettes, creases, where
// the exit lobe falls off) each is its own, so that edges are anti-aliased and what is inside them is not blurred.
// What varies slowly enough lets the samples of an edge share one, too.
#include "lib/octahedral.glsl"

uniform sampler2D geometry;
uniform vec3 cameraPosition;
uniform vec3 cameraRight;    // times the tangent of half the horizontal angle
uniform vec3 cameraUp;       // times the tangent of half the vertical angle
uniform vec3 cameraForward;
uniform float objectNumber;
uniform float shareWithin;   // samples this near share a receiver, though they do not fill the pixel or their exit lobes differ
uniform int anyLobe;         // 1: one smooth piece is one receiver whatever its exit lobes

// Cosines to the camera so close together, the less the flatter, have one exit lobe. As reference/camera_receivers.cpp.
const float kLobeSpread = 0.25;

struct Receiver {
  vec3 position;  // scene units
  vec3 normal;
  vec3 view;      // towards the camera
  vec4 cosO;      // of its samples; all alike where it has one, or one lobe
  float weight;   // share of the pixel, a quarter for each sample
};

vec3 rayThrough(vec2 sampleCoordinate) {
  vec2 ndc = sampleCoordinate / vec2(textureSize(geometry, 0)) * 2.0 - 1.0;
  return cameraForward + cameraRight * ndc.x + cameraUp * ndc.y;
}

Receiver receiverAt(vec3 position, vec3 normal, float weight) {
  vec3 view = normalize(cameraPosition - position);
  return Receiver(position, normal, view, vec4(clamp(dot(normal, view), 0.0, 1.0)), weight);
}

// One receiver for the first `count` samples, the places after which hold the last: if there are four and they are one smooth
// piece, normals within about 25 degrees, points near one plane in terms of their own spread, and of one exit lobe; or if they
// are near together and do not face away from each other.
bool together(vec3 positions[4], vec3 normals[4], int count, out Receiver receiver) {
  vec3 centre = vec3(0.0);
  vec3 normal = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    float share = i < count ? 1.0 / float(count) : 0.0;
    centre += share * positions[i];
    normal += share * normals[i];
  }
  float agreement = length(normal);
  normal = normalize(normal);
  float spread = max(max(distance(positions[0], positions[3]), distance(positions[1], positions[2])),
                     distance(positions[0], positions[1]));
  receiver = receiverAt(centre, normal, 0.25 * float(count));
  float off = 0.0;
  vec4 cosO;
  for (int i = 0; i < 4; ++i) {
    off = max(off, abs(dot(positions[i] - centre, normal)));
    cosO[i] = dot(normals[i], normalize(cameraPosition - positions[i]));
  }
  float least = min(min(cosO.x, cosO.y), min(cosO.z, cosO.w));
  float most = max(max(cosO.x, cosO.y), max(cosO.z, cosO.w));
  bool oneLobe = most - least < kLobeSpread * least * least;
  if (!oneLobe || count < 4) receiver.cosO = clamp(cosO, 0.0, 1.0);
  bool onePiece = count == 4 && agreement > 0.975 && off < 0.25 * spread;
  return (onePiece && (oneLobe || anyLobe == 1)) || (spread < shareWithin && agreement > 0.9);
}

// Those of a pixel, asked for in turn by nextReceiver: an array that an index picks from lies in memory, lane by lane.
struct Receivers {
  int count;  // 0 to 4
  Receiver first;
  vec3 positions[4];  // of the samples; the places after the last hold it, too
  vec3 normals[4];
};

// Receivers of this object among the 2 x 2 samples from `first` on.
Receivers loadReceivers(ivec2 first) {
  Receivers all;
  all.count = 0;
  for (int i = 0; i < 4; ++i) {
    ivec2 texel = first + ivec2(i & 1, i >> 1);
    vec4 g = texelFetch(geometry, texel, 0);
    if (g.w != objectNumber) continue;
    vec3 position = cameraPosition + rayThrough(vec2(texel) + 0.5) * g.x;
    vec3 normal = octDecode(g.yz);
    // Constant indices keep the arrays in registers.
    for (int j = 0; j < 4; ++j) {
      if (j < all.count) continue;
      all.positions[j] = position;
      all.normals[j] = normal;
    }
    ++all.count;
  }
  if (all.count > 0 && together(all.positions, all.normals, all.count, all.first))
    all.count = 1;
  else
    all.first = receiverAt(all.positions[0], all.normals[0], 0.25);
  return all;
}

// Number 1 to 3.
Receiver nextReceiver(Receivers all, int number) {
  vec3 position = number == 1 ? all.positions[1] : (number == 2 ? all.positions[2] : all.positions[3]);
  vec3 normal = number == 1 ? all.normals[1] : (number == 2 ? all.normals[2] : all.normals[3]);
  return receiverAt(position, normal, 0.25);
}
