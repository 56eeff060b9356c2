// Reads two textures at one coordinate and level; used for mip levels, filters, borders and units.
uniform sampler2D first;
uniform sampler2D second;
uniform vec2 coordinate;
uniform float level;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 other;

void main() {
  colour = textureLod(first, coordinate, level);
  other = textureLod(second, coordinate, level);
}
