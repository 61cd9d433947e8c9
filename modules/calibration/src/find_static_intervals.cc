#include "find_static_intervals.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <vector>

#include "asperity/base/units.h"

namespace asperity {

namespace {

struct Block {
  PoseRange rows;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  double position_noise_m = 0.0, rotation_noise_rad = 0.0;  // of one pose, from second differences
};

// Poses scatter about a smooth motion by their second differences, of variance six times the noise's.
void measure_noise(const TrackerStream& tracker, Block& block) {
  double position = 0.0, rotation = 0.0;
  std::size_t count = 0;
  for (std::size_t i = block.rows.first + 1; i + 1 < block.rows.last; ++i, ++count) {
    const Pose& a = tracker.T_world_marker[i - 1];
    const Pose& b = tracker.T_world_marker[i];
    const Pose& c = tracker.T_world_marker[i + 1];
    position += (a.translation_m - 2.0 * b.translation_m + c.translation_m).squaredNorm();
    rotation += (log_rotation(a.rotation * b.rotation.conjugate()) + log_rotation(c.rotation * b.rotation.conjugate()))
                    .squaredNorm();
  }
  if (count == 0) return;
  block.position_noise_m = std::sqrt(position / (6.0 * static_cast<double>(count)));
  block.rotation_noise_rad = std::sqrt(rotation / (6.0 * static_cast<double>(count)));
}

std::vector<Block> make_blocks(const TrackerStream& tracker, const TrackerNoiseConfig& config) {
  std::vector<Block> blocks;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= tracker.size(); ++i) {
    const bool ends = i == tracker.size() ||
                      static_cast<double>(tracker.t_ns[i] - tracker.t_ns[first]) * kNanosecond_s >= config.block_s;
    if (!ends) continue;
    Block block;
    block.rows = {first, i};
    for (std::size_t k = first; k < i; ++k) {
      block.position_m += tracker.T_world_marker[k].translation_m / static_cast<double>(i - first);
    }
    block.rotation = mean_rotation(tracker, block.rows);
    measure_noise(tracker, block);
    blocks.push_back(block);
    first = i;
  }
  return blocks;
}

bool gap_between(const TrackerStream& tracker, const Block& a, const Block& b, const TrackerNoiseConfig& config) {
  const auto gap_ns = tracker.t_ns[b.rows.first] - tracker.t_ns[a.rows.last - 1];
  return static_cast<double>(gap_ns) * kNanosecond_s > config.largest_gap_s;
}

// The median of what has come so far, of two in the middle the greater.
class RunningMedian {
 public:
  void add(double value) {
    if (upper_.empty() || value >= upper_.top()) {
      upper_.push(value);
    } else {
      lower_.push(value);
    }
    if (upper_.size() > lower_.size() + 1) {
      lower_.push(upper_.top());
      upper_.pop();
    } else if (lower_.size() > upper_.size()) {
      upper_.push(lower_.top());
      lower_.pop();
    }
  }
  double value() const { return upper_.top(); }

 private:
  std::priority_queue<double> lower_;
  std::priority_queue<double, std::vector<double>, std::greater<>> upper_;
};

}  // namespace

Eigen::Quaterniond mean_rotation(const TrackerStream& tracker, PoseRange range) {
  const Eigen::Quaterniond& reference = tracker.T_world_marker[range.first].rotation;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (std::size_t i = range.first; i < range.last; ++i) {
    const Eigen::Vector4d q = tracker.T_world_marker[i].rotation.coeffs();
    sum += q.dot(reference.coeffs()) < 0.0 ? Eigen::Vector4d(-q) : q;
  }
  return Eigen::Quaterniond(sum).normalized();
}

std::vector<PoseRange> find_static_intervals(const TrackerStream& tracker, const TrackerNoiseConfig& config,
                                             LongestRest* longest) {
  const std::vector<Block> blocks = make_blocks(tracker, config);
  std::vector<PoseRange> rests;
  std::size_t first = 0;
  while (first < blocks.size()) {
    // Noise alone takes the means of blocks apart by this much at most.
    constexpr double kByChance = 5.0;
    Eigen::Vector3d centre = blocks[first].position_m;
    RunningMedian position_noise, rotation_noise;
    std::size_t last = first;
    double moved_m = 0.0, rotated_rad = 0.0;
    while (last < blocks.size()) {
      const Block& block = blocks[last];
      if (last > first && gap_between(tracker, blocks[last - 1], block, config)) break;
      const double count = std::sqrt(static_cast<double>(block.rows.last - block.rows.first));
      position_noise.add(block.position_noise_m);
      rotation_noise.add(block.rotation_noise_rad);
      const double position_m = config.rest_position_m + kByChance * position_noise.value() / count;
      const double rotation_rad = config.rest_rotation_rad + kByChance * rotation_noise.value() / count;
      const double away_m = (block.position_m - centre).norm();
      const double away_rad = log_rotation(block.rotation * blocks[first].rotation.conjugate()).norm();
      if (away_m > position_m || away_rad > rotation_rad) {
        moved_m = away_m;
        rotated_rad = away_rad;
        break;
      }
      ++last;
      centre += (block.position_m - centre) / static_cast<double>(last - first);
    }
    const double held_s =
        static_cast<double>(tracker.t_ns[blocks[last - 1].rows.last - 1] - tracker.t_ns[blocks[first].rows.first]) *
        kNanosecond_s;
    if (longest != nullptr && held_s > longest->length_s) *longest = {held_s, moved_m, rotated_rad};
    if (last >= first + 3) {
      const PoseRange rest{blocks[first + 1].rows.first, blocks[last - 2].rows.last};
      const double length_s =
          static_cast<double>(tracker.t_ns[rest.last - 1] - tracker.t_ns[rest.first]) * kNanosecond_s;
      const bool poses = rest.last - rest.first >= static_cast<std::size_t>(config.least_poses);
      if (poses && length_s >= config.least_rest_s) {
        rests.push_back(rest);
        first = last;
        continue;
      }
    }
    ++first;
  }
  return rests;
}

}  // namespace asperity
