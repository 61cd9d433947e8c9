#pragma once

#include <algorithm>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>

namespace asperity {

// A queue of fixed capacity from one thread to one other, boost::lockfree's: push() is the producer's, pop() and
// read_available() are the consumer's. Neither side locks, waits or allocates; when it is full, push() refuses.
template <class T>
class SpscQueue : public boost::lockfree::spsc_queue<T> {
 public:
  // Room for `capacity` items; all memory is taken and touched here, so that no page fault comes later.
  explicit SpscQueue(std::size_t capacity) : boost::lockfree::spsc_queue<T>(std::max<std::size_t>(capacity, 1)) {
    while (this->push(T{})) {
    }
    this->reset();
  }
};

}  // namespace asperity
