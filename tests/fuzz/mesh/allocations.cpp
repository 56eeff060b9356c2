#include "fuzz/mesh/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<size_t> largest{0};
}

size_t largestAllocation() {
  return largest;
}
void resetLargestAllocation() {
  largest = 0;
}

void* operator new(size_t size) {
  size_t before = largest;
  while (before < size && !largest.compare_exchange_weak(before, size)) {
  }
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
  std::free(memory);
}
