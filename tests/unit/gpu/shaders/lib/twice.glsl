vec4 twice(vec4 v) { return v + v; }
