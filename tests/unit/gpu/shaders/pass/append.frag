// Every pixel of the lower row appends its column.
layout(std430) buffer List {
  uint count;
  uint list[];
};
layout(location = 0) out vec4 colour;

void main() {
  if (gl_FragCoord.y < 1.0) list[atomicAdd(count, 1u)] = uint(gl_FragCoord.x);
  colour = vec4(0.0);
}
