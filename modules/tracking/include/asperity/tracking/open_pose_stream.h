#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/tracking/pose_source.h"
#include "asperity/transport/byte_source.h"

namespace asperity {

// Where another tracker's poses come from, as people type it: "udp:[ADDRESS:]PORT", "file:PATH", or "pipe:PATH" for a
// FIFO. The bytes are lines as in pose_lines.h; over UDP a datagram holds whole lines.
struct PoseAddress {
  enum class Kind { kUdp, kFile, kPipe };
  Kind kind = Kind::kUdp;
  std::string address = "127.0.0.1";  // udp; 0.0.0.0 hears all who reach it
  std::uint16_t port = 0;             // udp
  std::string path;                   // file, pipe
};

// Throws Error naming the text and what is allowed.
PoseAddress parse_pose_address(std::string_view text);

// Opens what the address names; throws Error if it cannot. Lines that begin with the name of one of `bodies` are that
// body's (pose_lines.h).
std::unique_ptr<PoseSource> open_pose_stream(const PoseAddress& address, const std::vector<std::string>& bodies = {});

// Whose clock the times in the lines are of.
enum class PoseTimes {
  kAsWritten,     // of any one clock: taken as they are
  kHostClock,     // this host's monotonic one: what is more than a second ahead of its arrival is no pose
  kSendersClock,  // any that counts ns: brought to the host's by device_clock.h, whose constant delay is latency
};

// The poses in the lines that `bytes` gives. Over UDP open_pose_stream takes the sender's clock: another machine has
// another one.
std::unique_ptr<PoseSource> make_pose_stream(std::unique_ptr<ByteSource> bytes, PoseTimes times = PoseTimes::kAsWritten,
                                             const std::vector<std::string>& bodies = {});

}  // namespace asperity
