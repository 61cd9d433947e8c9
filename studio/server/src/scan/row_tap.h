#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "asperity/camera/camera_source.h"
#include "asperity/recorder/recorder.h"
#include "asperity/tracking/tracked_pose.h"

namespace asperity::studio {

// A camera's image made small for a browser: `factor` by `factor` pixels became one.
struct SmallImage {
  std::int64_t t_ns = 0;
  int factor = 1;
  GrayImage image;
};

// An image with the pose that was found in it, if any.
struct SeenImage {
  SmallImage small;
  std::optional<TrackedPose> pose;
};

// A copy of what the sensors give, for the display. The sensors' threads put rows in and never wait for longer
// than a copy takes; what nobody fetches in time is dropped and counted, the recorder has it all the same. Thread-safe.
class RowTap {
 public:
  static constexpr std::size_t kMostRows = 65'536;
  static constexpr std::size_t kMostPoses = 4'096;
  static constexpr int kWidestImage_px = 640;
  static constexpr std::int64_t kImagePeriod_ns = 60'000'000;
  static constexpr std::int64_t kPoseWait_ns = 150'000'000;  // then an image goes without

  void add(std::span<const ProbeSample> rows);
  void add(const TrackedPose& pose);
  // Keeps a small copy if images are needed and the last one is old enough. It goes with the pose of the same time; a
  // newer one replaces it until that has come. In the thread that adds the poses.
  void add(const CameraFrame& frame);
  void want_images(bool wanted) { images_wanted_ = wanted; }

  struct TakenRows {
    std::vector<ProbeSample> rows;
    std::uint64_t first_row = 0;  // number of the first of `rows` among all that came
    std::vector<TrackedPose> poses;
    std::optional<SeenImage> image;  // the newest, if there is a new one
    std::uint64_t rows_dropped = 0;  // since the beginning
    std::uint64_t poses_dropped = 0;
  };
  // All that waits; the memory of `out` is used in turn.
  void take(TakenRows& out);

 private:
  void keep(const std::optional<TrackedPose>& pose);

  std::atomic<bool> images_wanted_{false};
  std::int64_t next_image_ns_ = 0;                // of the camera's thread, as the next two
  std::optional<SmallImage> pending_;             // waits for its pose
  std::optional<std::int64_t> pending_since_ns_;  // since when there has been one
  std::mutex mutex_;
  std::vector<ProbeSample> rows_;
  std::vector<TrackedPose> poses_;
  std::optional<SeenImage> image_;
  std::uint64_t rows_came_ = 0;
  std::uint64_t rows_dropped_ = 0;
  std::uint64_t poses_dropped_ = 0;
};

// The image by means over squares of pixels, at most `widest_px` wide.
SmallImage make_small(const CameraFrame& frame, int widest_px);

// The same sensors, with a copy of all they give in `tap`, which has to outlive them.
RecorderSensors with_tap(RecorderSensors sensors, RowTap& tap);

}  // namespace asperity::studio
