#include "asperity/tracking/open_pose_stream.h"

#include <array>
#include <cstdlib>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "asperity/link/device_clock.h"
#include "asperity/tracking/pose_lines.h"
#include "asperity/transport/open_path.h"
#include "asperity/transport/open_udp.h"

namespace asperity {

namespace {

// The sender's clock is another one if it leaps by more than this against ours.
constexpr std::int64_t kLeap_ns = 5'000'000'000;

// A pose that had one time far ahead would make all later ones late.
constexpr std::int64_t kAhead_ns = 1'000'000'000;

// Brings times of a sender's clock to the host's.
class SenderClock {
 public:
  std::int64_t to_host(std::int64_t sender_ns, std::int64_t arrival_ns) {
    // Both lie within 0 and 2^62: their difference fits.
    const std::int64_t offset_ns = arrival_ns - sender_ns;
    if (!offset_ns_ || std::abs(offset_ns - *offset_ns_) > kLeap_ns) {
      clock_.restart();
      begin_ns_ = sender_ns;
    }
    offset_ns_ = offset_ns;
    // From its beginning: a clock that counts from 1970 is beyond what DeviceClock takes.
    clock_.observe(sender_ns - begin_ns_, arrival_ns);
    return clock_.stamp(sender_ns - begin_ns_);
  }

 private:
  std::optional<std::int64_t> offset_ns_;  // of the two clocks, as last seen
  std::int64_t begin_ns_ = 0;
  DeviceClock clock_;
};

class PoseStream : public PoseSource {
 public:
  PoseStream(std::unique_ptr<ByteSource> bytes, PoseTimes times, const std::vector<std::string>& bodies)
      : bytes_(std::move(bytes)), times_(times), lines_(bodies) {
    if (!bytes_) throw Error("tracking needs a stream of poses, and none was given");
  }

  std::optional<TrackedPose> read(std::chrono::milliseconds timeout) override {
    if (waiting_.empty()) {
      const Arrival arrival = bytes_->read(buffer_, timeout);
      poses_.clear();
      lines_.push(std::span(buffer_).first(arrival.count), arrival.arrival_ns, poses_);
      if (times_ == PoseTimes::kHostClock) {
        ahead_ += std::erase_if(poses_,
                                [&](const TrackerSample& pose) { return pose.t_ns > arrival.arrival_ns + kAhead_ns; });
      }
      for (TrackerSample& pose : poses_) {
        // Those without a time of their own have the arrival's.
        if (times_ == PoseTimes::kSendersClock && pose.t_ns != arrival.arrival_ns) {
          pose.t_ns = sender_.to_host(pose.t_ns, arrival.arrival_ns);
        }
      }
      waiting_.insert(waiting_.end(), poses_.begin(), poses_.end());
      statistics_.frames += poses_.size();
    }
    if (waiting_.empty()) return std::nullopt;
    TrackedPose out;
    out.sample = waiting_.front();
    waiting_.pop_front();
    ++statistics_.poses;
    return out;
  }

  TrackingStatistics statistics() const override { return statistics_; }
  std::string name() const override { return bytes_->name(); }
  std::vector<std::string> warnings() const override {
    std::vector<std::string> out;
    if (lines_.bad_lines() > 0) out.push_back(std::to_string(lines_.bad_lines()) + " lines were not poses");
    if (ahead_ > 0) out.push_back(std::to_string(ahead_) + " poses had times ahead of this host's clock");
    return out;
  }

 private:
  std::unique_ptr<ByteSource> bytes_;
  PoseTimes times_;
  SenderClock sender_;
  PoseLines lines_;
  std::size_t ahead_ = 0;
  std::array<std::uint8_t, 65536> buffer_{};
  std::vector<TrackerSample> poses_;
  std::deque<TrackerSample> waiting_;
  TrackingStatistics statistics_;
};

[[noreturn]] void refuse(std::string_view text) {
  throw Error("'" + printable(text) + "' is not a source of poses; give udp:[ADDRESS:]PORT, file:PATH or pipe:PATH");
}

}  // namespace

PoseAddress parse_pose_address(std::string_view text) {
  PoseAddress out;
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos || colon + 1 == text.size()) refuse(text);
  const std::string_view kind = text.substr(0, colon);
  std::string_view rest = text.substr(colon + 1);
  if (kind == "file" || kind == "pipe") {
    out.kind = kind == "file" ? PoseAddress::Kind::kFile : PoseAddress::Kind::kPipe;
    out.path = rest;
    return out;
  }
  if (kind != "udp") refuse(text);
  if (const std::size_t last = rest.rfind(':'); last != std::string_view::npos) {
    out.address = rest.substr(0, last);
    rest = rest.substr(last + 1);
    if (out.address.starts_with('[') && out.address.ends_with(']'))
      out.address = out.address.substr(1, out.address.size() - 2);
  }
  const auto port = parse_int64(rest);
  if (!port || *port < 1 || *port > 65'535 || out.address.empty()) refuse(text);
  out.port = static_cast<std::uint16_t>(*port);
  return out;
}

std::unique_ptr<PoseSource> open_pose_stream(const PoseAddress& address, const std::vector<std::string>& bodies) {
  if (address.kind == PoseAddress::Kind::kFile)
    return make_pose_stream(open_path(address.path), PoseTimes::kAsWritten, bodies);
  if (address.kind == PoseAddress::Kind::kPipe) {
    return make_pose_stream(open_path(address.path), PoseTimes::kHostClock, bodies);
  }
  UdpConfig udp;
  udp.address = address.address;
  udp.port = address.port;
  udp.shows_sender = [bodies](std::span<const std::uint8_t> datagram) {
    PoseLines lines(bodies);
    std::vector<TrackerSample> poses;
    lines.push(datagram, host_now_ns(), poses);
    return !poses.empty();
  };
  return make_pose_stream(open_udp(udp), PoseTimes::kSendersClock, bodies);
}

std::unique_ptr<PoseSource> make_pose_stream(std::unique_ptr<ByteSource> bytes, PoseTimes times,
                                             const std::vector<std::string>& bodies) {
  return std::make_unique<PoseStream>(std::move(bytes), times, bodies);
}

}  // namespace asperity
