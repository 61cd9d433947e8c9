#include "asperity/acquire/open_pose_stream.h"

#include <array>
#include <deque>
#include <utility>
#include <vector>

#include "asperity/acquire/open_udp.h"
#include "asperity/acquire/pose_lines.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "path_source.h"

namespace asperity {

namespace {

class PoseStream : public PoseSource {
 public:
  explicit PoseStream(std::unique_ptr<ByteSource> bytes) : bytes_(std::move(bytes)) {
    if (!bytes_) throw Error("there is no stream of poses");
  }

  std::optional<TrackedPose> read(std::chrono::milliseconds timeout) override {
    if (waiting_.empty()) {
      const Arrival arrival = bytes_->read(buffer_, timeout);
      poses_.clear();
      lines_.push(std::span(buffer_).first(arrival.count), arrival.arrival_ns, poses_);
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
    if (lines_.bad_lines() == 0) return {};
    return {std::to_string(lines_.bad_lines()) + " lines were no poses"};
  }

 private:
  std::unique_ptr<ByteSource> bytes_;
  PoseLines lines_;
  std::array<std::uint8_t, 65536> buffer_{};
  std::vector<TrackerSample> poses_;
  std::deque<TrackerSample> waiting_;
  TrackingStatistics statistics_;
};

[[noreturn]] void refuse(std::string_view text) {
  throw Error("'" + printable(text) + "' is no source of poses: udp:[ADDRESS:]PORT, file:PATH or pipe:PATH");
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

std::unique_ptr<PoseSource> open_pose_stream(const PoseAddress& address) {
  if (address.kind != PoseAddress::Kind::kUdp) return make_pose_stream(open_path(address.path));
  UdpConfig udp;
  udp.address = address.address;
  udp.port = address.port;
  return make_pose_stream(open_udp(udp));
}

std::unique_ptr<PoseSource> make_pose_stream(std::unique_ptr<ByteSource> bytes) {
  return std::make_unique<PoseStream>(std::move(bytes));
}

}  // namespace asperity
