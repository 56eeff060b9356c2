// Number i of the list goes to texel `list[i]`, and its double into the list itself; more groups than numbers.
layout(local_size_x = 4) in;
layout(std430) buffer List {
  uint count;
  uint list[];
};
layout(rgba32f) writeonly uniform image2D target;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  imageStore(target, ivec2(int(list[i]), 0), vec4(float(i) + 1.0, 0.0, 0.0, 1.0));
  list[i] *= 2u;
}
