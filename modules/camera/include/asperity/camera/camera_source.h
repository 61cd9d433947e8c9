#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "asperity/image/gray_image.h"

namespace asperity {

struct CameraFrame {
  std::int64_t t_ns = 0;  // of its arrival on the host's monotonic clock, by the driver if it gives one
  GrayImage image;
};

// Where images come from: a camera, a video, a folder of images, a stream. One thread at a time.
class CameraSource {
 public:
  virtual ~CameraSource() = default;

  // Waits at most `timeout` for the next frame and puts it into `frame`, whose memory is used again; false if none
  // came in time. Throws LinkLost when no more can come, Error for anything else that fails.
  virtual bool read(CameraFrame& frame, std::chrono::milliseconds timeout) = 0;

  virtual double nominal_rate_Hz() const { return 0.0; }  // 0: unknown
  virtual std::string name() const = 0;

  // What a person should know of how the images are taken: "focus is not locked: …". Empty: nothing.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace asperity
