#pragma once

#include <cstddef>

namespace asperity::testkit {

// How often operator new was called in this program so far, by any thread. A program that calls this has its
// operators new and delete replaced by counting ones.
std::size_t count_allocations();

// The same of the calling thread alone: where other threads of the program may allocate meanwhile.
std::size_t count_own_allocations();

// The calling thread's operator new throws std::bad_alloc once, after `later` further allocations. Negative: not at
// all.
void fail_allocation(long later);
// How many are left until it throws; negative if it has thrown or will not.
long allocations_until_failure();

}  // namespace asperity::testkit
