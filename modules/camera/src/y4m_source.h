#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "asperity/camera/camera_source.h"
#include "asperity/image/y4m.h"
#include "child_process.h"

namespace asperity {

// A YUV4MPEG2 stream from an open file or pipe; see open_y4m.h.
class Y4mSource final : public CameraSource {
 public:
  // `is_file`: frames without times have their index over the rate, and the header must be there.
  Y4mSource(OwnedFile file, std::string name, bool is_file);

  // Waits for the header until `deadline_ns` of the host's clock; false if it is not whole by then or never will be.
  // Throws Error for one that cannot be used.
  bool wait_for_header(std::int64_t deadline_ns);

  bool read(CameraFrame& frame, std::chrono::milliseconds timeout) override;
  double nominal_rate_Hz() const override;
  std::string name() const override { return name_; }

 private:
  bool wait_for_frame(std::int64_t deadline_ns);
  bool advance();
  bool take_header();
  void begin_frame(std::string_view line);
  std::int64_t finish_time();
  std::optional<std::string_view> take_line();
  bool fill(std::int64_t deadline_ns);

  OwnedFile file_;
  std::string name_;
  bool is_file_ = false;
  bool ended_ = false;
  bool failed_ = false;
  std::optional<Y4mHeader> header_;

  std::array<char, 64 * 1024> buffer_{};
  std::size_t begin_ = 0, end_ = 0;  // of the bytes that wait in it
  std::int64_t last_read_ns_ = 0;

  GrayImage image_;  // of the frame that is coming
  bool in_frame_ = false;
  std::size_t luma_done_ = 0, chroma_left_ = 0;
  std::int64_t index_ = 0;  // frames given out
  bool timed_ = false;
  std::int64_t t_ns_ = 0;
};

}  // namespace asperity
