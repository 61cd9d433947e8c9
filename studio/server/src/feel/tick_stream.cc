#include "feel/tick_stream.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "asperity/device/safety_cause.h"

namespace asperity::studio {

namespace {

constexpr double kFrames_Hz = 60.0;
constexpr double kHighPass_Hz = 30.0;  // below, a hand is pushed rather than vibrated
constexpr double kSpeed_s = 0.02;      // over which the point's speed is smoothed
constexpr std::int64_t kMostHeld = 100;
constexpr std::array<std::string_view, 4> kStatusNames{"ready", "stalled", "fault", "ended"};

double signed_texture_N(const ServoOutput& output) {
  const double magnitude_N = output.texture_N.norm();
  return output.texture_N.dot(output.contact.normal_world) < 0.0 ? -magnitude_N : magnitude_N;
}

void add_vector(BlockWriter& block, std::string_view name, const Eigen::Vector3d& v) {
  const std::array<double, 3> numbers{v.x(), v.y(), v.z()};
  block.add(name, std::span<const double>(numbers));
}

}  // namespace

TickStream::TickStream(Hub& hub, double rate_Hz, std::uint64_t run, bool blind)
    : hub_(hub),
      rate_Hz_(rate_Hz),
      run_(run),
      blind_(blind),
      frame_ticks_(static_cast<std::uint64_t>(std::max(1.0, std::round(rate_Hz / kFrames_Hz)))),
      late_(std::make_unique<DurationHistogram>()),
      late_until_(static_cast<std::uint64_t>(rate_Hz)),
      high_pass_(SecondOrderFilter::high_pass(kHighPass_Hz, rate_Hz)) {}

void TickStream::add(const ServoTick& tick) {
  if (since_frame_ == 0) {
    wants_state_ = hub_.has_subscribers(kFeelStateTopic);
    wants_ticks_ = !blind_ && hub_.has_subscribers(kFeelTicksTopic);
    const bool sound = hub_.has_subscribers(kFeelSoundTopic);
    if (!sound) sounding_ = false;
    wants_sound_ = sound;
  }
  const std::int64_t since =
      ticks_ == 0 ? 1 : std::llround(static_cast<double>(tick.t_ns - last_.t_ns) * 1e-9 * rate_Hz_);
  skipped_ += static_cast<std::uint64_t>(std::max<std::int64_t>(0, since - 1));
  if (ticks_ == 0) last_ = tick;
  follow(tick);
  if (wants_ticks_) {
    t_s_.push_back(1e-9 * static_cast<double>(tick.t_ns));
    contact_N_.push_back(static_cast<float>(tick.output.contact_N.norm()));
    texture_N_.push_back(static_cast<float>(signed_texture_N(tick.output)));
    friction_N_.push_back(static_cast<float>(tick.output.friction_N.norm()));
    out_N_.push_back(static_cast<float>(tick.out_world_N.norm()));
    height_m_.push_back(static_cast<float>(tick.output.texture_height_m));
    way_mm_.push_back(static_cast<float>(1e3 * way_m_));
    speed_mps_.push_back(static_cast<float>(v_world_mps_.norm()));
  }
  if (wants_sound_) add_sound(tick, since);
  last_ = tick;
  ++ticks_;
  if (++since_frame_ >= frame_ticks_) flush();
}

void TickStream::follow(const ServoTick& tick) {
  const double dt_s = 1e-9 * static_cast<double>(tick.t_ns - last_.t_ns);
  const Eigen::Vector3d step_m = tick.p_world_m - last_.p_world_m;
  if (dt_s > 0.0 && step_m.allFinite()) {
    v_world_mps_ += std::min(1.0, dt_s / kSpeed_s) * (step_m / dt_s - v_world_mps_);
  }
  const Eigen::Vector3d along_m = tick.output.proxy_m - last_.output.proxy_m;
  if (tick.output.contact.found() && last_.output.contact.found() && along_m.allFinite()) way_m_ += along_m.norm();
  limited_by_ |= tick.limited_by;
  late_->add(tick.late_ns);
  if (late_->count() >= late_until_) {
    late_p99_s_ = 1e-9 * static_cast<double>(late_->percentile_ns(0.99));
    late_max_s_ = 1e-9 * static_cast<double>(late_->max_ns());
    *late_ = DurationHistogram();
  }
}

// Ticks that were left out are held, so that the sound keeps its time.
void TickStream::add_sound(const ServoTick& tick, std::int64_t ticks_since) {
  const double force_N = axis_.push(tick.out_world_N, v_world_mps_, tick.t_ns);
  if (!sounding_) {
    high_pass_ = SecondOrderFilter::high_pass(kHighPass_Hz, rate_Hz_);
    high_pass_.start_high_pass_at(force_N);
    sounding_ = true;
    ticks_since = 1;
  }
  for (std::int64_t k = std::clamp<std::int64_t>(ticks_since, 1, kMostHeld); k > 0; --k) {
    sound_N_.push_back(static_cast<float>(high_pass_(force_N)));
  }
}

void TickStream::flush() {
  since_frame_ = 0;
  if (ticks_ == 0) return;
  if (wants_state_) send_state();
  if (!t_s_.empty()) send_ticks();
  if (!sound_N_.empty()) send_sound();
}

void TickStream::send_state() {
  BlockWriter block(kFeelStateTopic);
  Json& head = block.head();
  head["topic"] = kFeelStateTopic;
  const ServoOutput& output = last_.output;
  head["run"] = run_;
  head["t_s"] = 1e-9 * static_cast<double>(last_.t_ns);
  head["status"] = kStatusNames[static_cast<std::size_t>(last_.reading.status)];
  head["gain"] = last_.gain;
  head["limited"] = Json::array();
  for (std::size_t k = 0; k < kSafetyCauseNames.size(); ++k) {
    if ((limited_by_ >> k & 1U) != 0) head["limited"].push_back(kSafetyCauseNames[k]);
  }
  limited_by_ = 0;
  head["touching"] = output.contact.found();
  // Of a blind scene: the point and the total force, nothing of the surface.
  const Eigen::Vector3d hidden = Eigen::Vector3d::Zero();
  head["sticking"] = !blind_ && output.sticking;
  head["starts_inside"] = !blind_ && output.starts_inside;
  head["height_m"] = blind_ ? 0.0 : output.texture_height_m;
  head["way_m"] = blind_ ? 0.0 : way_m_;
  head["speed_mps"] = v_world_mps_.norm();
  head["late_p99_us"] = late_p99_s_ * 1e6;
  head["late_max_us"] = late_max_s_ * 1e6;
  head["skipped"] = skipped_;
  add_vector(block, "p_world_m", last_.p_world_m);
  add_vector(block, "proxy_m", blind_ ? last_.p_world_m : output.proxy_m);
  add_vector(block, "normal_world", blind_ ? hidden : output.contact.normal_world);
  add_vector(block, "contact_N", blind_ ? hidden : output.contact_N);
  add_vector(block, "texture_N", blind_ ? hidden : output.texture_N);
  add_vector(block, "friction_N", blind_ ? hidden : output.friction_N);
  add_vector(block, "out_world_N", last_.out_world_N);
  hub_.publish(kFeelStateTopic, block.take(), Delivery::kLatest);
}

void TickStream::send_ticks() {
  BlockWriter block(kFeelTicksTopic);
  block.head()["topic"] = kFeelTicksTopic;
  block.head()["run"] = run_;
  block.head()["sequence"] = ticks_sequence_++;
  block.head()["rate_Hz"] = rate_Hz_;
  block.add("t_s", std::span<const double>(t_s_));
  t_s_.clear();
  const std::array<std::pair<std::string_view, std::vector<float>*>, 7> rows{{{"contact_N", &contact_N_},
                                                                              {"texture_N", &texture_N_},
                                                                              {"friction_N", &friction_N_},
                                                                              {"out_N", &out_N_},
                                                                              {"height_m", &height_m_},
                                                                              {"way_mm", &way_mm_},
                                                                              {"speed_mps", &speed_mps_}}};
  for (const auto& [name, row] : rows) {
    block.add(name, std::span<const float>(*row));
    row->clear();
  }
  hub_.publish(kFeelTicksTopic, block.take(), Delivery::kSeries);
}

void TickStream::send_sound() {
  BlockWriter block(kFeelSoundTopic);
  block.head()["topic"] = kFeelSoundTopic;
  block.head()["run"] = run_;
  block.head()["sequence"] = sound_sequence_++;
  block.head()["rate_Hz"] = rate_Hz_;
  block.add("force_N", std::span<const float>(sound_N_));
  sound_N_.clear();
  hub_.publish(kFeelSoundTopic, block.take(), Delivery::kSeries);
}

}  // namespace asperity::studio
