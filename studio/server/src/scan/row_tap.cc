#include "scan/row_tap.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace asperity::studio {

namespace {

class TappedProbe : public ProbeSource {
 public:
  TappedProbe(std::unique_ptr<ProbeSource> source, RowTap& tap) : source_(std::move(source)), tap_(tap) {}

  void read(std::vector<ProbeSample>& out, std::chrono::milliseconds timeout) override {
    const std::size_t before = out.size();
    try {
      source_->read(out, timeout);
    } catch (...) {
      // What came before the link was lost is recorded too.
      tap_.add(std::span(out).subspan(before));
      throw;
    }
    tap_.add(std::span(out).subspan(before));
  }
  LinkStatistics statistics() const override { return source_->statistics(); }
  std::optional<ProbeDescription> description() const override { return source_->description(); }
  std::string name() const override { return source_->name(); }

 private:
  std::unique_ptr<ProbeSource> source_;
  RowTap& tap_;
};

class TappedPoses : public PoseSource {
 public:
  TappedPoses(std::unique_ptr<PoseSource> source, RowTap& tap) : source_(std::move(source)), tap_(tap) {}

  std::optional<TrackedPose> read(std::chrono::milliseconds timeout) override {
    auto pose = source_->read(timeout);
    // What is live is the probe in the tracker's world: of an object that moves the recording knows.
    if (pose && pose->sample.body == 0) tap_.add(*pose);
    return pose;
  }
  TrackingStatistics statistics() const override { return source_->statistics(); }
  double nominal_rate_Hz() const override { return source_->nominal_rate_Hz(); }
  std::string name() const override { return source_->name(); }
  std::vector<std::string> warnings() const override { return source_->warnings(); }

 private:
  std::unique_ptr<PoseSource> source_;
  RowTap& tap_;
};

}  // namespace

void RowTap::add(std::span<const ProbeSample> rows) {
  if (rows.empty()) return;
  const std::lock_guard lock(mutex_);
  rows_came_ += rows.size();
  // All or nothing of what waits: the rows that are taken follow each other without a gap.
  if (rows_.size() + rows.size() > kMostRows) {
    rows_dropped_ += rows_.size();
    rows_.clear();
  }
  rows_.insert(rows_.end(), rows.begin(), rows.end());
}

void RowTap::add(const TrackedPose& pose) {
  if (pending_ && pending_->t_ns == pose.sample.t_ns) keep(pose);
  const std::lock_guard lock(mutex_);
  if (poses_.size() >= kMostPoses) {
    poses_dropped_ += poses_.size();
    poses_.clear();
  }
  poses_.push_back(pose);
}

void RowTap::add(const CameraFrame& frame) {
  if (!images_wanted_ || frame.t_ns < next_image_ns_) return;
  pending_ = make_small(frame, kWidestImage_px);
  if (!pending_since_ns_) pending_since_ns_ = frame.t_ns;
  if (frame.t_ns - *pending_since_ns_ >= kPoseWait_ns) keep(std::nullopt);
}

void RowTap::keep(const std::optional<TrackedPose>& pose) {
  next_image_ns_ = pending_->t_ns + kImagePeriod_ns;
  SeenImage seen{std::move(*pending_), pose};
  pending_.reset();
  pending_since_ns_.reset();
  const std::lock_guard lock(mutex_);
  image_ = std::move(seen);
}

void RowTap::take(TakenRows& out) {
  out.rows.clear();
  out.poses.clear();
  out.image.reset();
  const std::lock_guard lock(mutex_);
  rows_.swap(out.rows);
  poses_.swap(out.poses);
  image_.swap(out.image);
  out.first_row = rows_came_ - out.rows.size();
  out.rows_dropped = rows_dropped_;
  out.poses_dropped = poses_dropped_;
}

SmallImage make_small(const CameraFrame& frame, int widest_px) {
  const GrayImage& from = frame.image;
  SmallImage out;
  out.t_ns = frame.t_ns;
  out.factor = std::max(1, (from.width + widest_px - 1) / widest_px);
  if (out.factor == 1) {
    out.image = from;
    return out;
  }
  const int n = out.factor;
  out.image.width = from.width / n;
  out.image.height = from.height / n;
  out.image.pixels.reserve(static_cast<std::size_t>(out.image.width) * static_cast<std::size_t>(out.image.height));
  for (int row = 0; row < out.image.height; ++row) {
    for (int column = 0; column < out.image.width; ++column) {
      int sum = n * n / 2;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) sum += from.at(n * column + j, n * row + i);
      }
      out.image.pixels.push_back(static_cast<std::uint8_t>(sum / (n * n)));
    }
  }
  return out;
}

RecorderSensors with_tap(RecorderSensors sensors, RowTap& tap) {
  if (sensors.open_probe) {
    sensors.open_probe = [open = std::move(sensors.open_probe), &tap]() -> std::unique_ptr<ProbeSource> {
      auto source = open();
      if (!source) return nullptr;
      return std::make_unique<TappedProbe>(std::move(source), tap);
    };
  }
  if (sensors.open_poses) {
    sensors.open_poses = [open = std::move(sensors.open_poses), &tap]() -> std::unique_ptr<PoseSource> {
      auto source = open();
      if (!source) return nullptr;
      return std::make_unique<TappedPoses>(std::move(source), tap);
    };
  }
  return sensors;
}

}  // namespace asperity::studio
