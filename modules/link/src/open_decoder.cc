#include "open_decoder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace asperity {

namespace {

constexpr std::uint32_t kHalf = 0x80000000U;
constexpr std::int64_t kLongestSilence_us = 3'600'000'000;  // of a clock that goes on
constexpr std::int64_t kLongestRun_us = std::int64_t{1} << 48;
constexpr std::uint32_t kLateRun_frames = 8;
constexpr std::int64_t kLateRun_ns = 500'000'000;
constexpr std::size_t kMaxWaitingForces = 64;
constexpr double kForceReach_ns = 10e6;  // farther from every row a force sample is of a stretch that was lost

}  // namespace

void OpenDecoder::push(std::span<const std::uint8_t> bytes, std::int64_t arrival_ns, std::vector<ProbeSample>& out) {
  statistics_.bytes += bytes.size();
  while (!bytes.empty()) {
    const void* found = std::memchr(bytes.data(), 0, bytes.size());
    const std::size_t size = found != nullptr
                                 ? static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - bytes.data())
                                 : bytes.size();
    const auto piece = bytes.first(size);
    if (found != nullptr && block_.empty() && !block_too_long_ && size <= kOpenMaxBlock_bytes) {
      take_block(piece, arrival_ns, out);
    } else {
      if (block_.size() + size > kOpenMaxBlock_bytes) {
        block_too_long_ = true;
        block_.clear();
      }
      if (!block_too_long_) block_.insert(block_.end(), piece.begin(), piece.end());
      if (found != nullptr) {
        if (block_too_long_) {
          ++statistics_.damaged_frames;
          in_damage_ = true;
        } else {
          take_block(block_, arrival_ns, out);
        }
        block_.clear();
        block_too_long_ = false;
      }
    }
    bytes = bytes.subspan(found != nullptr ? size + 1 : size);
  }
}

void OpenDecoder::take_block(std::span<const std::uint8_t> block, std::int64_t arrival_ns,
                             std::vector<ProbeSample>& out) {
  if (block.empty()) return;
  const auto payload = open_block_payload(block, payload_);
  bool sound = payload.has_value();
  if (sound) {
    const std::uint8_t version = (*payload)[0];
    const std::uint8_t type = (*payload)[1];
    if (version == kOpenVersion && type == kOpenSamplesType) {
      sound = take_samples(*payload, arrival_ns, out);
    } else if (version == kOpenVersion && type == kOpenDescriptionType) {
      const auto json = payload->subspan(2);
      auto description = parse_open_description({reinterpret_cast<const char*>(json.data()), json.size()});
      sound = description.has_value();
      if (sound) {
        description_ = std::move(description);
      }
    } else if (version == kOpenVersion && type == kOpenFaultsType) {
      const auto faults = parse_open_faults(*payload);
      sound = faults.has_value();
      if (sound) statistics_.faults = *faults;
    } else {
      ++statistics_.foreign_frames;
    }
  }
  if (!sound) ++statistics_.damaged_frames;
  if (sound && in_damage_) ++statistics_.resyncs;
  in_damage_ = !sound;
}

bool OpenDecoder::take_samples(std::span<const std::uint8_t> payload, std::int64_t arrival_ns,
                               std::vector<ProbeSample>& out) {
  if (!parse_open_samples(payload, samples_)) return false;
  if (!is_wanted(arrival_ns)) {
    ++statistics_.late_frames;
    return true;
  }
  ++statistics_.frames;
  if (samples_.overrun) ++statistics_.overruns;
  count_losses();

  const auto time_ns = static_cast<std::int64_t>(samples_.time_us - origin_us_) * 1000;
  const auto rows_after_first = static_cast<std::int64_t>(samples_.row_count == 0 ? 0 : samples_.row_count - 1);
  // The frame was sent when its last row had been taken.
  clock_.observe(time_ns + rows_after_first * std::int64_t{samples_.imu_period_ns}, arrival_ns);
  give_rows(time_ns, out);
  return true;
}

// False for a frame that came late or twice. Finds out whether the probe began to count anew.
bool OpenDecoder::is_wanted(std::int64_t arrival_ns) {
  const StartMark mark{samples_.sequence, samples_.imu_index, samples_.time_us};
  if (samples_.start && start_ == mark) return false;
  if (!counting_ || samples_.start) {
    begin_count(counting_);
    if (samples_.start) start_ = mark;
    return true;
  }
  const std::uint32_t ahead = samples_.sequence - newest_sequence_;
  if (ahead != 0 && ahead < kHalf) {
    if (!goes_on()) begin_count(true);
    return true;
  }
  // A restart whose first frame was lost looks like frames that come late, but goes on doing so.
  const bool follows = late_run_ > 0 && samples_.sequence - late_sequence_ - 1 < kLateRun_frames &&
                       samples_.time_us - late_time_us_ - 1 < std::uint64_t{kLongestSilence_us};
  if (!follows) {
    late_run_ = 0;
    late_since_ns_ = arrival_ns;
  }
  ++late_run_;
  late_sequence_ = samples_.sequence;
  late_time_us_ = samples_.time_us;
  if (late_run_ < kLateRun_frames || arrival_ns - late_since_ns_ < kLateRun_ns) return false;
  begin_count(true);
  return true;
}

// Whether the time and the rows' number of a frame with a later sequence agree with a probe that never stopped.
bool OpenDecoder::goes_on() const {
  const auto ahead_us = static_cast<std::int64_t>(samples_.time_us - newest_time_us_);
  const auto run_us = static_cast<std::int64_t>(samples_.time_us - origin_us_);
  // A frame without rows may be sent while the rows of the next are being taken.
  const bool both_have_rows = samples_.row_count > 0 && newest_has_rows_;
  return ahead_us >= (both_have_rows ? 1 : -kLongestSilence_us) && ahead_us <= kLongestSilence_us &&
         run_us >= -kLongestSilence_us && run_us <= kLongestRun_us && samples_.imu_index - next_imu_index_ < kHalf;
}

void OpenDecoder::begin_count(bool restarted) {
  if (restarted) {
    ++statistics_.restarts;
    clock_.restart();
  }
  counting_ = true;
  newest_sequence_ = samples_.sequence - 1;
  next_imu_index_ = samples_.imu_index;
  origin_us_ = samples_.time_us;
  newest_time_us_ = samples_.time_us;
  newest_has_rows_ = false;
  row_period_ns_ = 0.0;
  forces_.clear();
}

void OpenDecoder::count_losses() {
  statistics_.lost_frames += samples_.sequence - newest_sequence_ - 1;
  statistics_.lost_samples += samples_.imu_index - next_imu_index_;
  newest_sequence_ = samples_.sequence;
  late_run_ = 0;
  if (samples_.row_count > 0) {
    const std::uint32_t rows = samples_.imu_index - newest_imu_index_;
    if (samples_.row_count > 1) {
      row_period_ns_ = samples_.imu_period_ns;
    } else if (newest_has_rows_ && rows > 0) {
      row_period_ns_ = 1e3 * static_cast<double>(samples_.time_us - newest_time_us_) / rows;
    }
    newest_imu_index_ = samples_.imu_index;
    newest_time_us_ = samples_.time_us;
    newest_has_rows_ = true;
  } else if (!newest_has_rows_) {
    newest_time_us_ = samples_.time_us;
  }
  next_imu_index_ = samples_.imu_index + static_cast<std::uint32_t>(samples_.row_count);
}

void OpenDecoder::give_rows(std::int64_t time_ns, std::vector<ProbeSample>& out) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::size_t first = out.size();
  out.resize(first + samples_.row_count);
  const std::span<ProbeSample> rows(out.data() + first, samples_.row_count);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const OpenRow& from = samples_.rows[i];
    rows[i].t_ns = clock_.stamp(time_ns + static_cast<std::int64_t>(i) * std::int64_t{samples_.imu_period_ns});
    for (int axis = 0; axis < 3; ++axis) {
      rows[i].accel_counts[axis] = from.accel[static_cast<std::size_t>(axis)];
      rows[i].gyro_counts[axis] = samples_.has_gyro ? from.gyro[static_cast<std::size_t>(axis)] : kNone;
      rows[i].force3_counts[axis] = kNone;
    }
  }
  statistics_.samples += rows.size();
  lay_forces(time_ns, rows);
}

// Puts the force samples that waited and those of the frame into the rows nearest in time; those that are nearer
// to a row still to come wait for it.
void OpenDecoder::lay_forces(std::int64_t time_ns, std::span<ProbeSample> rows) {
  for (std::size_t i = 0; i < samples_.force_count; ++i) {
    if (forces_.size() == kMaxWaitingForces) forces_.erase(forces_.begin());
    const OpenForce& force = samples_.forces[i];
    forces_.push_back({time_ns + std::int64_t{force.offset_us} * 1000, force.counts, samples_.has_force3});
  }
  if (rows.empty() || forces_.empty()) return;
  force_counts_.assign(rows.size(), 0);
  const double period_ns = std::max(1.0, row_period_ns_);
  const double reach_ns = std::max(kForceReach_ns, period_ns);
  const auto last = static_cast<double>(rows.size() - 1);
  std::erase_if(forces_, [&](const Force& force) {
    const auto after_ns = static_cast<double>(force.device_ns - time_ns);
    const double place = after_ns / period_ns;
    if (place > last + 0.5) return false;
    if (after_ns < -reach_ns) return true;
    const auto row = static_cast<std::size_t>(std::lround(std::clamp(place, 0.0, last)));
    ++statistics_.force_samples;
    // The mean so far, if a row gets several.
    const double share = 1.0 / ++force_counts_[row];
    const auto blend = [share](double mean, double value) {
      return share == 1.0 ? value : mean + share * (value - mean);
    };
    const std::size_t axial = force.is_force3 ? 2 : 0;
    rows[row].force_counts = blend(rows[row].force_counts, force.counts[axial]);
    if (!force.is_force3) return true;
    for (int axis = 0; axis < 3; ++axis) {
      rows[row].force3_counts[axis] =
          blend(rows[row].force3_counts[axis], force.counts[static_cast<std::size_t>(axis)]);
    }
    return true;
  });
}

}  // namespace asperity
