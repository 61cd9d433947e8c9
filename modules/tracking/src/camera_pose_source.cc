#include "asperity/tracking/camera_pose_source.h"

#include <cstdint>
#include <deque>
#include <exception>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/recording/tracked_body.h"
#include "asperity/transport/byte_source.h"

namespace asperity {

namespace {

class CameraPoses : public PoseSource {
 public:
  CameraPoses(std::unique_ptr<CameraSource> camera, BodyTracker tracker, const CameraPoseConfig& config,
              std::function<void(const CameraFrame&)> on_frame, std::vector<BodyTracker> further)
      : camera_(std::move(camera)),
        tracker_(std::move(tracker)),
        further_(std::move(further)),
        config_(config),
        on_frame_(std::move(on_frame)) {
    if (!camera_) throw Error("tracking needs a camera, and none was given");
  }

  std::optional<TrackedPose> read(std::chrono::milliseconds timeout) override {
    if (waiting_.empty()) {
      if (!next(timeout)) return std::nullopt;
      if (config_.newest) pass_over();
      look_for_bodies();
    }
    if (waiting_.empty()) return std::nullopt;
    TrackedPose out = std::move(waiting_.front());
    waiting_.pop_front();
    return out;
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
    for (const BodyTracker& body : further_) {
      for (const Problem& problem : body.problems()) out.push_back(problem.message);
    }
    return out;
  }

 private:
  bool next(std::chrono::milliseconds timeout) {
    if (lost_) std::rethrow_exception(std::exchange(lost_, nullptr));
    if (!camera_->read(frame_, timeout)) return false;
    if (on_frame_) on_frame_(frame_);
    return true;
  }

  void look_for_bodies() {
    if (auto pose = tracker_.push(frame_.image, frame_.t_ns)) waiting_.push_back(std::move(*pose));
    for (std::size_t i = 0; i < further_.size(); ++i) {
      auto pose = further_[i].push(frame_.image, frame_.t_ns);
      if (!pose) continue;
      pose->sample.body = i + 1;
      waiting_.push_back(std::move(*pose));
    }
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
  std::vector<BodyTracker> further_;
  std::deque<TrackedPose> waiting_;  // of the frame
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
                                                    std::function<void(const CameraFrame&)> on_frame,
                                                    std::vector<BodyTracker> further) {
  return std::make_unique<CameraPoses>(std::move(camera), std::move(tracker), config, std::move(on_frame),
                                       std::move(further));
}

std::vector<BodyTracker> make_further_trackers(const CameraCalibration& camera,
                                               const std::vector<MarkerPlacement>& markers, const TrackConfig& config) {
  std::vector<BodyTracker> out;
  for (const std::string& body : bodies_of(markers)) out.emplace_back(camera, markers_of_body(markers, body), config);
  return out;
}

}  // namespace asperity
