#pragma once

#include <cstddef>

namespace asperity::testkit {

// How often operator new was called in this program so far, by any thread. A program that calls this has its
// operators new and delete replaced by counting ones.
std::size_t count_allocations();

// The same of the calling thread alone: where other threads of the program may allocate meanwhile.
std::size_t count_own_allocations();

}  // namespace asperity::testkit
