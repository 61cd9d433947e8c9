#include "asperity/link/open_capture.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/csv.h"
#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "capture_format.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMaxArrivalsFile_bytes = std::uint64_t{1} << 30;
constexpr double kPieces_per_s = 1000.0;
constexpr std::int64_t kLongestCapture_ns = std::int64_t{1} << 58;

struct Piece {
  std::size_t bytes = 0;
  std::int64_t after_ns = 0;  // the first one's arrival
};

std::vector<Piece> read_arrivals(const fs::path& path) {
  const std::string text = read_file(path, kMaxArrivalsFile_bytes);
  CsvReader csv(text, path.string());
  const std::size_t bytes = csv.require("bytes");
  const std::size_t arrival = csv.require("arrival_ns");
  std::vector<Piece> pieces;
  std::int64_t first_ns = 0;
  while (csv.next()) {
    const std::int64_t count = csv.integer(bytes);
    const std::int64_t at_ns = csv.integer(arrival);
    if (count < 1) csv.fail(bytes, "must be at least 1");
    if (at_ns < -kLongestCapture_ns || at_ns > kLongestCapture_ns) csv.fail(arrival, "is not a valid time");
    if (pieces.empty()) first_ns = at_ns;
    if (!pieces.empty() && at_ns - first_ns < pieces.back().after_ns) csv.fail(arrival, "is before the line above");
    pieces.push_back({static_cast<std::size_t>(count), at_ns - first_ns});
  }
  return pieces;
}

class CaptureSource : public ByteSource {
 public:
  CaptureSource(const fs::path& path, const CaptureConfig& config)
      : name_("file:" + printable(path.string(), 200)), config_(config), file_(path, std::ios::binary) {
    if (!file_ || fs::is_directory(path)) throw Error(name_ + ": cannot be read");
    if (config.bytes_per_s < 0.0 || !std::isfinite(config.bytes_per_s)) {
      throw Error(fmt::format("{}: {} is not a byte rate", name_, config.bytes_per_s));
    }
    if (config.bytes_per_s > 0.0) {
      piece_bytes_ = static_cast<std::size_t>(std::clamp(config.bytes_per_s / kPieces_per_s, 1.0, 1e6));
      return;
    }
    if (!fs::exists(arrivals_path(path))) {
      throw Error(fmt::format(
          "{}: when its bytes came is not known: there is no {}; give their rate (file:PATH@BYTES_PER_SECOND)", name_,
          printable(arrivals_path(path).string(), 200)));
    }
    arrivals_ = read_arrivals(arrivals_path(path));
  }

  Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override {
    if (into.empty()) return {};
    if (left_ == 0) next_piece();
    if (config_.real_time && !wait(timeout)) return {};
    const std::size_t wanted = std::min(left_, into.size());
    file_.read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(wanted));
    const auto count = static_cast<std::size_t>(file_.gcount());
    if (count == 0) end();
    left_ -= count;
    return {count, config_.start_ns + after_ns_};
  }

  bool write(std::span<const std::uint8_t>) override { return false; }
  std::string name() const override { return name_; }

 private:
  void next_piece() {
    if (config_.bytes_per_s > 0.0) {
      left_ = piece_bytes_;
      position_ += static_cast<double>(piece_bytes_);
      after_ns_ = static_cast<std::int64_t>(std::min(1e9 * position_ / config_.bytes_per_s, 1e18));
      return;
    }
    if (next_arrival_ == arrivals_.size()) end();
    left_ = arrivals_[next_arrival_].bytes;
    after_ns_ = arrivals_[next_arrival_++].after_ns;
  }

  // False if the piece is not due in time.
  bool wait(std::chrono::milliseconds timeout) {
    const std::int64_t now_ns = host_now_ns();
    if (began_ns_ == 0) began_ns_ = now_ns;
    const std::int64_t left_ns = began_ns_ + after_ns_ - now_ns;
    const std::int64_t timeout_ns = std::chrono::nanoseconds(timeout).count();
    if (left_ns > 0) std::this_thread::sleep_for(std::chrono::nanoseconds(std::min(left_ns, timeout_ns)));
    return left_ns <= timeout_ns;
  }

  [[noreturn]] void end() const { throw LinkLost(name_ + ": is at its end"); }

  std::string name_;
  CaptureConfig config_;
  std::ifstream file_;
  std::vector<Piece> arrivals_;
  std::size_t next_arrival_ = 0;
  std::size_t piece_bytes_ = 0;
  double position_ = 0.0;
  std::size_t left_ = 0;  // of the piece
  std::int64_t after_ns_ = 0;
  std::int64_t began_ns_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> open_capture(const fs::path& path, const CaptureConfig& config) {
  return std::make_unique<CaptureSource>(path, config);
}

}  // namespace asperity
