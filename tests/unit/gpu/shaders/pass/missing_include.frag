// The second line includes a file that is not there.
#include "lib/not_there.glsl"
void main() {}
