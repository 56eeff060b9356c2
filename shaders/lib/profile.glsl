// Coordinate of distance r in a profile's table. Twin: ProfileTable in optics/profile.h.
float profileCoordinate(float r, float scale) { return r / (r + scale); }
