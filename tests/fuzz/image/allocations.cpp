// The counting operator new is the same in every fuzz program.
#include "fuzz/mesh/allocations.cpp"
