#pragma once

#include <cstdint>
#include <string>

namespace asperity::studio {

// One browser that has shown the token: what it got its cookie for.
struct SessionInfo {
  std::uint64_t number = 0;
  std::string opened;  // UTC, "2026-11-24T03:00:00Z"
  std::string from;    // the address that it came from, "127.0.0.1"
  std::string agent;   // what the browser calls itself: not to be relied on, and printable
  int windows = 0;     // WebSockets that are open now
};

}  // namespace asperity::studio
