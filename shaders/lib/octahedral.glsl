// Unit vectors as two numbers in [-1, 1]. Cigolle et al. 2014, "A survey of efficient representations for independent
// unit vectors", listing 1 (oct).

float octSign(float x) { return x >= 0.0 ? 1.0 : -1.0; }

vec2 octEncode(vec3 n) {
  float s = 1.0 / (abs(n.x) + abs(n.y) + abs(n.z));
  vec2 p = vec2(n.x * s, n.y * s);
  if (n.z < 0.0) p = vec2((1.0 - abs(p.y)) * octSign(p.x), (1.0 - abs(p.x)) * octSign(p.y));
  return p;
}

vec3 octDecode(vec2 p) {
  vec3 n = vec3(p.x, p.y, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n = vec3((1.0 - abs(p.y)) * octSign(p.x), (1.0 - abs(p.x)) * octSign(p.y), n.z);
  return normalize(n);
}
