#pragma once

#include <cstddef>

/// The largest single allocation by operator new since the last reset, in bytes. The test program's operator
/// new is replaced to know it (in a file of its own, so that the compiler cannot see through new and delete).
size_t largestAllocation();
void resetLargestAllocation();
