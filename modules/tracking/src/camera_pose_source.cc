#include "asperity/tracking/camera_pose_source.h"

#include <cstdint>
#include <exception>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/transport/byte_source.h"

namespace asperity {

namespace {

class CameraPoses : public PoseSource {
 public:
  CameraPoses(std::unique_ptr<CameraSource> camera, BodyTracker tracker, const CameraPoseConfig& config,
              std::function<void(const CameraFrame&)> on_frame)
      : camera_(std::move(camera)), tracker_(std::move(tracker)), config_(config), on_frame_(std::move(on_frame)) {
    if (!camera_) throw Error("there is no camera to track in");
  }

  std::optional<TrackedPose> read(std::chrono::milliseconds timeout) override {
    if (!next(timeout)) return std::nullopt;
    if (config_.newest) pass_over();
    return tracker_.push(frame_.image, frame_.t_ns);
  }

  TrackingStatistics statistics() const override {
    TrackingStatistics out = tracker_.statistics();
    out.frames += skipped_;
    out.skipped_frames += skipped_;
    return out;
  }

  double nominal_rate_Hz() const override { return config_.nominal_rate_Hz; }
  std::string name() const override { return camera_->name(); }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> out = camera_->warnings();
    for (const Problem& problem : tracker_.problems()) out.push_back(problem.message);
    return out;
  }

 private:
  bool next(std::chrono::milliseconds timeout) {
    if (lost_) std::rethrow_exception(std::exchange(lost_, nullptr));
    if (!camera_->read(frame_, timeout)) return false;
    if (on_frame_) on_frame_(frame_);
    return true;
  }

  // On to the newest frame that is there. A camera faster than the loop's reading must not keep it here.
  void pass_over() {
    constexpr int kMost = 100;
    for (int i = 0; i < kMost; ++i) {
      std::swap(frame_, newest_);
      bool came = false;
      try {
        came = next(std::chrono::milliseconds(0));
      } catch (const Error&) {
        // The frame before is still good; the next call reports the loss.
        lost_ = std::current_exception();
      }
      if (!came) {
        std::swap(frame_, newest_);
        return;
      }
      ++skipped_;
    }
  }

  std::unique_ptr<CameraSource> camera_;
  BodyTracker tracker_;
  CameraPoseConfig config_;
  std::function<void(const CameraFrame&)> on_frame_;
  CameraFrame frame_;
  CameraFrame newest_;  // the last that is known to be whole
  std::uint64_t skipped_ = 0;
  std::exception_ptr lost_;
};

}  // namespace

std::unique_ptr<PoseSource> make_camera_pose_source(std::unique_ptr<CameraSource> camera, BodyTracker tracker,
                                                    const CameraPoseConfig& config,
                                                    std::function<void(const CameraFrame&)> on_frame) {
  return std::make_unique<CameraPoses>(std::move(camera), std::move(tracker), config, std::move(on_frame));
}

}  // namespace asperity
