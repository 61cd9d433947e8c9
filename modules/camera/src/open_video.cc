#include "asperity/camera/open_video.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <string_view>

#include "asperity/transport/byte_source.h"

namespace asperity {

namespace {

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

class VideoSource final : public CameraSource {
 public:
  explicit VideoSource(const std::filesystem::path& path) : name_("video:" + path.string()) {
    check_container(path, name_);
    try {
      capture_.open(path.string(), cv::CAP_FFMPEG);
    } catch (const cv::Exception&) {
      capture_.release();
    }
    if (!capture_.isOpened()) throw Error(name_ + ": the video is damaged or of a kind that cannot be decoded");
    const double width = capture_.get(cv::CAP_PROP_FRAME_WIDTH), height = capture_.get(cv::CAP_PROP_FRAME_HEIGHT);
    if (!(std::min(width, height) >= 1.0 && std::max(width, height) <= kLargestImageSide_px)) {
      throw Error(name_ + ": its images have " + std::to_string(std::llround(width)) + " x " +
                  std::to_string(std::llround(height)) + " pixels");
    }
    // Pixels stay where the lens put them.
    capture_.set(cv::CAP_PROP_ORIENTATION_AUTO, 0.0);
    const double rate_Hz = capture_.get(cv::CAP_PROP_FPS);
    if (rate_Hz > 0.0 && rate_Hz <= 1e5) rate_Hz_ = rate_Hz;
  }

  bool read(CameraFrame& frame, std::chrono::milliseconds) override {
    bool there = false;
    try {
      there = capture_.read(image_) && !image_.empty();
      if (there && image_.channels() == 3) {
        cv::cvtColor(image_, gray_, cv::COLOR_BGR2GRAY);
      } else {
        gray_ = image_;
      }
    } catch (const cv::Exception&) {
      throw LinkLost(name_ + ": is damaged behind image " + std::to_string(index_));
    }
    if (!there) throw LinkLost(name_ + ": has ended after image " + std::to_string(index_));
    if (gray_.type() != CV_8UC1 || gray_.cols > kLargestImageSide_px || gray_.rows > kLargestImageSide_px) {
      throw Error(name_ + ": image " + std::to_string(index_ + 1) + " is of a kind that cannot be used");
    }
    frame.t_ns = next_time(capture_.get(cv::CAP_PROP_POS_MSEC));
    frame.image.width = gray_.cols;
    frame.image.height = gray_.rows;
    frame.image.pixels.assign(gray_.begin<unsigned char>(), gray_.end<unsigned char>());
    ++index_;
    return true;
  }

  double nominal_rate_Hz() const override { return rate_Hz_; }
  std::string name() const override { return name_; }

 private:
  std::int64_t next_time(double container_ms) {
    const bool known = std::isfinite(container_ms) && std::abs(container_ms) < 1e12;
    const std::int64_t t_ns = known ? std::llround(container_ms * 1e6) : last_ns_;
    const std::int64_t step_ns = std::max<std::int64_t>(1, std::llround(1e9 / (rate_Hz_ > 0.0 ? rate_Hz_ : 30.0)));
    return last_ns_ = index_ > 0 && t_ns <= last_ns_ ? last_ns_ + step_ns : t_ns;
  }

  std::string name_;
  cv::VideoCapture capture_;
  cv::Mat image_, gray_;
  double rate_Hz_ = 0.0;
  std::int64_t index_ = 0;
  std::int64_t last_ns_ = 0;
};

}  // namespace

std::unique_ptr<CameraSource> open_video(const std::filesystem::path& path) {
  return std::make_unique<VideoSource>(path);
}

}  // namespace asperity
