#include "asperity/camera/open_video.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "asperity/transport/byte_source.h"
#include "child_process.h"
#include "y4m_source.h"

namespace asperity {

namespace {

// Longer than any image takes; a decoder that hangs must not hold the program.
constexpr std::chrono::seconds kLongestDecoding{60};
constexpr std::chrono::seconds kLastWords{1};  // from the end of its images to its own
constexpr int kTimesFile = 3;                  // where ffmpeg writes the images' times

bool is_known_container(std::string_view begin) {
  const std::string_view kind = begin.substr(std::min<std::size_t>(4, begin.size()));
  const bool avi = begin.starts_with("RIFF") && begin.substr(8).starts_with("AVI ");
  const bool mp4 = kind.starts_with("ftyp") || kind.starts_with("moov") || kind.starts_with("mdat") ||
                   kind.starts_with("wide") || kind.starts_with("free");
  return begin.size() == 12 && (avi || mp4 || begin.starts_with("\x1a\x45\xdf\xa3"));
}

void check_container(const std::filesystem::path& path, const std::string& name) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw Error(name + ": is not a file");
  std::string begin(12, '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file.read(begin.data(), static_cast<std::streamsize>(begin.size()))) begin.clear();
  if (!is_known_container(begin)) throw Error(name + ": is not a video that can be read (AVI, MP4, MOV, MKV or WebM)");
}

// Images as YUV4MPEG2 to standard output, and for each a line with its time to kTimesFile. Every image once, none
// turned; no file but this one is opened, whatever is in it.
std::vector<std::string> ffmpeg_command(const std::filesystem::path& path) {
  return {"ffmpeg",
          "-nostdin",
          "-hide_banner",
          "-loglevel",
          "error",
          "-noautorotate",
          "-protocol_whitelist",
          "file",
          "-format_whitelist",
          "avi,mov,matroska",
          "-i",
          "file:" + path.string(),
          "-map",
          "0:v:0",
          "-fps_mode",
          "passthrough",
          "-pix_fmt",
          "gray",
          "-strict",
          "-1",
          "-f",
          "yuv4mpegpipe",
          "pipe:1",
          "-map",
          "0:v:0",
          "-fps_mode",
          "passthrough",
          "-enc_time_base",
          "-1",
          "-c:v",
          "wrapped_avframe",
          "-flush_packets",
          "1",
          "-f",
          "framecrc",
          "pipe:" + std::to_string(kTimesFile)};
}

// The times that ffmpeg's format "framecrc" lists: "#tb 0: 1/45", the seconds of a count, and a line for each image,
// "stream, dts, pts, …".
class TimeLines {
 public:
  explicit TimeLines(OwnedFile file) : file_(std::move(file)) {}

  // Of the next image, s; nullopt if none is told.
  std::optional<double> next_s() {
    for (;;) {
      const auto line = take_line();
      if (!line) return std::nullopt;
      if (line->starts_with("#tb 0: ")) set_unit(line->substr(7));
      if (!line->starts_with('#')) return seconds(*line);
    }
  }

 private:
  void set_unit(std::string_view text) {
    const auto slash = text.find('/');
    const auto over = parse_int64(trim(text.substr(0, slash)));
    const auto under = slash == std::string_view::npos ? std::nullopt : parse_int64(trim(text.substr(slash + 1)));
    if (over && under && *under != 0) unit_s_ = static_cast<double>(*over) / static_cast<double>(*under);
  }

  std::optional<double> seconds(std::string_view line) const {
    for (int field = 0; field < 2; ++field) line.remove_prefix(std::min(line.find(',') + 1, line.size()));
    const auto count = parse_int64(trim(line.substr(0, line.find(','))));
    if (!count) return std::nullopt;
    const double out = static_cast<double>(*count) * unit_s_;
    return std::abs(out) < 1e9 ? std::optional(out) : std::nullopt;
  }

  std::optional<std::string> take_line() {
    constexpr std::size_t kLongestLine = 1024;
    const std::int64_t deadline_ns = host_now_ns() + std::chrono::nanoseconds(kLongestDecoding).count();
    for (;;) {
      if (const auto newline = waiting_.find('\n'); newline != std::string::npos) {
        std::string out = waiting_.substr(0, newline);
        waiting_.erase(0, newline + 1);
        return out;
      }
      if (waiting_.size() > kLongestLine || host_now_ns() >= deadline_ns) return std::nullopt;
      pollfd wait{file_.get(), POLLIN, 0};
      if (::poll(&wait, 1, 1000) <= 0) continue;
      char buffer[4096];
      const ssize_t count = ::read(file_.get(), buffer, sizeof buffer);
      if (count == 0 || (count < 0 && errno != EINTR)) return std::nullopt;
      if (count > 0) waiting_.append(buffer, static_cast<std::size_t>(count));
    }
  }

  OwnedFile file_;
  std::string waiting_;
  double unit_s_ = std::numeric_limits<double>::quiet_NaN();
};

class VideoSource final : public CameraSource {
 public:
  explicit VideoSource(const std::filesystem::path& path) : name_("video:" + path.string()) {
    check_container(path, name_);
    start(path);
    const std::int64_t deadline_ns = host_now_ns() + std::chrono::nanoseconds(kLongestDecoding).count();
    if (!images_->wait_for_header(deadline_ns)) {
      throw Error(name_ + ": the video is damaged or of a kind that cannot be decoded" + words_of_ffmpeg());
    }
    const double rate_Hz = images_->nominal_rate_Hz();
    if (rate_Hz > 0.0 && rate_Hz <= 1e5) rate_Hz_ = rate_Hz;
  }

  bool read(CameraFrame& frame, std::chrono::milliseconds) override {
    try {
      if (!images_->read(frame, kLongestDecoding)) throw Error(name_ + ": ffmpeg is stuck");
    } catch (const LinkLost&) {
      if (ffmpeg_->wait(kLastWords)) throw LinkLost(name_ + ": has ended after image " + std::to_string(index_));
      throw LinkLost(name_ + ": is damaged behind image " + std::to_string(index_) + words_of_ffmpeg());
    }
    frame.t_ns = next_time(times_->next_s());
    ++index_;
    return true;
  }

  double nominal_rate_Hz() const override { return rate_Hz_; }
  std::string name() const override { return name_; }

 private:
  void start(const std::filesystem::path& path) {
    auto [images, images_end] = make_pipe();
    auto [times, times_end] = make_pipe();
    auto [words, words_end] = make_pipe();
    // What does not fit into the pipe is dropped: nobody reads it before the end.
    ::fcntl(words_end.get(), F_SETFL, O_NONBLOCK);
    ::fcntl(words.get(), F_SETFL, O_NONBLOCK);
    try {
      ffmpeg_.emplace(ffmpeg_command(path), std::vector<std::pair<int, int>>{{images_end.get(), STDOUT_FILENO},
                                                                             {words_end.get(), STDERR_FILENO},
                                                                             {times_end.get(), kTimesFile}});
    } catch (const std::system_error& error) {
      if (error.code().value() != ENOENT) throw Error(name_ + ": ffmpeg cannot be started: " + error.what());
      throw Error(name_ +
                  ": ffmpeg, which decodes videos, is not installed (Debian: sudo apt-get install ffmpeg); or make a "
                  "stream of it elsewhere, `ffmpeg -i VIDEO -pix_fmt gray -strict -1 -f yuv4mpegpipe FILE.y4m`, and "
                  "give y4m:FILE.y4m");
    }
    images_.emplace(std::move(images), name_, false);
    times_.emplace(std::move(times));
    words_ = std::move(words);
  }

  // ": " and the first of what it has said of a fault; it has ended or is ended here.
  std::string words_of_ffmpeg() {
    ffmpeg_->wait(kLastWords);
    char buffer[500];
    const ssize_t count = ::read(words_.get(), buffer, sizeof buffer);
    if (count <= 0) return "";
    return ": " + printable(trim(std::string_view(buffer, static_cast<std::size_t>(count))), 300);
  }

  std::int64_t next_time(std::optional<double> container_s) {
    if (container_s && !first_s_) first_s_ = container_s;
    const std::int64_t t_ns = container_s ? std::llround((*container_s - *first_s_) * 1e9) : last_ns_;
    const std::int64_t step_ns = std::max<std::int64_t>(1, std::llround(1e9 / (rate_Hz_ > 0.0 ? rate_Hz_ : 30.0)));
    return last_ns_ = index_ > 0 && t_ns <= last_ns_ ? last_ns_ + step_ns : t_ns;
  }

  std::string name_;
  OwnedFile words_;  // ffmpeg's, of faults
  std::optional<TimeLines> times_;
  std::optional<Y4mSource> images_;
  std::optional<ChildProcess> ffmpeg_;
  std::optional<double> first_s_;
  double rate_Hz_ = 0.0;
  std::int64_t index_ = 0;
  std::int64_t last_ns_ = 0;
};

}  // namespace

std::unique_ptr<CameraSource> open_video(const std::filesystem::path& path) {
  return std::make_unique<VideoSource>(path);
}

}  // namespace asperity
