// What a pass that shows a pixel's samples writes: a texel for each sample and one more for all of them.
uniform ivec2 pixel;  // of the picture, (0, 0) the lower left one

layout(location = 0) out vec4 place;  // u, v, level, width of the footprint on the map (u); last: receiver, their number
layout(location = 1) out vec4 share;  // radiosity that the sample adds, depth of the lit surface there; last: all of it
