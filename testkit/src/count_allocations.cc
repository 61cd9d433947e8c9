#include "asperity/testkit/count_allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> allocations{0};
thread_local std::size_t own_allocations = 0;
thread_local long until_failure = -1;

void count() {
  ++allocations;
  ++own_allocations;
}

bool fails() { return until_failure >= 0 && until_failure-- == 0; }

void* counted(std::size_t size, std::size_t alignment) {
  count();
  if (fails()) throw std::bad_alloc();
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  if (void* const p = std::aligned_alloc(alignment, whole > 0 ? whole : alignment)) return p;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  count();
  return fails() ? nullptr : std::malloc(size > 0 ? size : 1);
}
void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

namespace asperity::testkit {

std::size_t count_allocations() { return allocations; }

std::size_t count_own_allocations() { return own_allocations; }

void fail_allocation(long later) { until_failure = later; }

long allocations_until_failure() { return until_failure; }

}  // namespace asperity::testkit
