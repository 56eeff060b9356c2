float fine(float x) { return x; }

float broken(float x) { return x + undefinedName; }
