// Adds one component of one light to the picture.
uniform sampler2D layer;

layout(location = 0) out vec4 colour;

void main() { colour = vec4(texelFetch(layer, ivec2(gl_FragCoord.xy), 0).xyz, 0.0); }
