// What the window shows: one picture or two side by side or their difference, a layer of the frame, and the
// grid on the ground behind it. Display values, sRGB.
#define PICTURE 0
#define DEPTH 1
#define NORMAL 2
#define MAP_FLUX 3
#define MAP_COSINE 4

uniform vec4 area;  // lower left corner and size, in pixels of the target
uniform sampler2D leftPicture, rightPicture;
uniform int compareMode;  // 0 left alone, 1 wipe, 2 difference
uniform float wipe, meanOfRight, fullScale;
uniform float gain;
uniform int curve;  // 0 sRGB, 1 filmic (Hable 2010)
uniform int layer;
uniform sampler2D layerTexture;
uniform float layerLow, layerHigh, layerLevel;
uniform int grid;  // 1: draw it
uniform vec3 eye, right, up, forward;  // lengths over the grid's radius, origin under the object's centre
uniform float gridSpacing;

layout(location = 0) out vec4 colour;

vec3 srgb(vec3 linear) {
  vec3 low = 12.92 * linear;
  vec3 high = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
  return mix(high, low, vec3(lessThanEqual(linear, vec3(0.0031308))));
}

vec3 hable(vec3 x) {
  return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.30;
}

// As toneMap() of image/tone_map.cpp.
vec3 display(vec3 linear) {
  vec3 exposed = max(gain * linear, vec3(0.0));
  if (curve == 1) exposed = hable(min(2.0 * exposed, vec3(11.2))) / hable(vec3(11.2));
  return srgb(clamp(exposed, 0.0, 1.0));
}

// Bilinear; exactly the texel where the picture has the area's resolution.
vec4 fetch(sampler2D picture, vec2 uv) {
  ivec2 size = textureSize(picture, 0);
  if (size == ivec2(area.zw)) return texelFetch(picture, ivec2(uv * vec2(size)), 0);
  vec2 at = uv * vec2(size) - 0.5;
  ivec2 first = ivec2(floor(at));
  vec2 part = at - vec2(first);
  ivec2 last = size - 1;
  vec4 a = texelFetch(picture, clamp(first, ivec2(0), last), 0);
  vec4 b = texelFetch(picture, clamp(first + ivec2(1, 0), ivec2(0), last), 0);
  vec4 c = texelFetch(picture, clamp(first + ivec2(0, 1), ivec2(0), last), 0);
  vec4 d = texelFetch(picture, clamp(first + ivec2(1, 1), ivec2(0), last), 0);
  return mix(mix(a, b, part.x), mix(c, d, part.x), part.y);
}

// As errorMap() of image/error_map.cpp.
vec3 heat(float t) {
  float place = clamp(t, 0.0, 1.0) * 4.0;
  vec3 k0 = vec3(0.0, 0.0, 4.0), k1 = vec3(81.0, 18.0, 124.0), k2 = vec3(183.0, 55.0, 121.0);
  vec3 k3 = vec3(252.0, 137.0, 97.0), k4 = vec3(252.0, 253.0, 191.0);
  vec3 low = mix(k0, k1, clamp(place, 0.0, 1.0));
  low = mix(low, k2, clamp(place - 1.0, 0.0, 1.0));
  low = mix(low, k3, clamp(place - 2.0, 0.0, 1.0));
  return mix(low, k4, clamp(place - 3.0, 0.0, 1.0)) / 255.0;
}

float lines(vec2 p, float spacing) {
  vec2 q = p / spacing;
  vec2 width = max(fwidth(q), vec2(1e-6));
  vec2 near = abs(fract(q - 0.5) - 0.5) / width;
  // Where lines are nearer than two pixels they would be noise.
  vec2 fade = clamp(0.5 / width - 1.0, 0.0, 1.0);
  vec2 line = clamp(1.0 - near, 0.0, 1.0) * fade;
  return max(line.x, line.y);
}

float gridShare(vec2 uv) {
  vec3 ray = forward + right * (2.0 * uv.x - 1.0) + up * (2.0 * uv.y - 1.0);
  float t = -eye.y / min(ray.y, -1e-5);
  vec2 p = (eye + ray * t).xz;
  float strength = max(0.35 * lines(p, gridSpacing), 0.7 * lines(p, 5.0 * gridSpacing));
  float far = length(p);
  return ray.y < -1e-4 ? strength * (1.0 - smoothstep(0.8, 2.2, far)) : 0.0;
}

vec3 octDecode(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  return normalize(n);
}

vec3 shownLayer(vec2 uv) {
  if (layer == MAP_FLUX || layer == MAP_COSINE) {
    vec2 square = (uv - 0.5) * area.zw / min(area.z, area.w) + 0.5;
    if (any(notEqual(square, clamp(square, 0.0, 1.0)))) return vec3(0.06);
    vec4 texel = textureLod(layerTexture, square, layerLevel);
    return layer == MAP_FLUX ? srgb(vec3(clamp(texel.x, 0.0, 1.0))) : srgb(vec3(clamp(texel.y, 0.0, 1.0)));
  }
  ivec2 size = textureSize(layerTexture, 0);
  vec4 texel = texelFetch(layerTexture, min(ivec2(uv * vec2(size)), size - 1), 0);
  if (texel.w <= 0.0) return vec3(0.06);
  if (layer == NORMAL) return 0.5 + 0.5 * octDecode(texel.yz);
  return vec3(0.1 + 0.85 * (1.0 - clamp((texel.x - layerLow) / (layerHigh - layerLow), 0.0, 1.0)));
}

void main() {
  vec2 uv = (gl_FragCoord.xy - area.xy) / area.zw;
  if (layer != PICTURE) {
    colour = vec4(shownLayer(uv), 1.0);
    return;
  }
  vec4 shown = fetch(leftPicture, uv);
  // Derivatives want every pixel of a quad; so this stands before any branch.
  float gridded = grid == 1 ? gridShare(uv) : 0.0;
  if (compareMode == 1 && uv.x > wipe) shown = fetch(rightPicture, uv);
  if (compareMode == 2) {
    vec4 other = fetch(rightPicture, uv);
    vec3 difference = abs(shown.rgb - other.rgb);
    float relative = (difference.r + difference.g + difference.b) / (3.0 * meanOfRight);
    colour = vec4(other.a > 0.0 ? heat(relative / fullScale) : vec3(0.12), 1.0);
    return;
  }
  vec3 result = display(shown.rgb);
  colour = vec4(mix(result, vec3(0.42, 0.43, 0.45), gridded * (1.0 - clamp(shown.a, 0.0, 1.0))), 1.0);
}
