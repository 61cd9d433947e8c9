#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "asperity/base/problem.h"

namespace asperity {

// Counts problems by kind; the message is that of the first.
class ProblemCounter {
 public:
  explicit ProblemCounter(Problems& problems) : problems_(problems) {}

  // `message()` is called for the first of its kind only.
  template <class Message>
  void count(const std::string& kind, Message&& message) {
    const auto same =
        std::find_if(problems_.begin(), problems_.end(), [&](const Problem& p) { return p.kind == kind; });
    if (same != problems_.end()) {
      ++same->count;
    } else {
      problems_.push_back({kind, std::forward<Message>(message)()});
    }
  }

 private:
  Problems& problems_;
};

}  // namespace asperity
