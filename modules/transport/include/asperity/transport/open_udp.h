#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "asperity/transport/byte_source.h"

namespace asperity {

struct UdpConfig {
  std::string address = "127.0.0.1";  // of this host, IPv4 or IPv6; 0.0.0.0 hears all who reach it
  std::uint16_t port = 0;             // 0: any free one, see name()
  bool any_sender = false;            // else the first sender is the probe; others are passed over
  double silence_s = 2.0;             // after which the probe may come back from another port of its address
  // True of bytes by which a sender shows that it speaks the protocol: its datagrams so far, one behind another, of
  // which the newest 4 KiB are kept. Until one has, all are passed over, and so are those from another port after a
  // silence. Without it the first datagram is taken.
  std::function<bool(std::span<const std::uint8_t>)> shows_sender = {};
};

// Waits for datagrams. What is written goes to the sender heard last; false before there is one. Never throws LinkLost:
// silence is all that a socket can tell. Throws Error naming the address if it cannot be bound.
std::unique_ptr<ByteSource> open_udp(const UdpConfig& config);

}  // namespace asperity
