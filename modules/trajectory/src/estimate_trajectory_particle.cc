#include "asperity/trajectory/estimate_trajectory_particle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "causal_feed.h"
#include "forward_filter.h"
#include "inertial_model.h"

namespace asperity {

namespace {

using inertial_smoother::CausalFeed;
using inertial_smoother::CausalMotion;
using inertial_smoother::Checkpoint;
using inertial_smoother::PointState;
using inertial_smoother::StepFilter;
using Window = inertial_smoother::Problem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kUngated = 1e300;
constexpr double kLowestScale = 0.3;  // as fused's: the sensors' own noise is a floor
const double kLogTwoPi = std::log(2.0 * std::numbers::pi);

struct Particle {
  Checkpoint at;
  double process_scale = 1.0;
  double rate_scale = 1.0;  // on the gyroscope's noise; without one, on the angular acceleration
  bool wild = false;
  double log_weight = 0.0;
};

class ParticleFilter {
 public:
  ParticleFilter(const Recording& recording, const FusedConfig& model, const ParticleConfig& config)
      : calibration_(recording.calibration),
        model_(model),
        config_(config),
        random_(static_cast<std::uint64_t>(config.seed)),
        out_(recording.calibration) {}

  void begin(const CausalFeed& feed);
  void run(const CausalFeed& feed, bool output);
  TrajectoryResult result();

 private:
  void set(const Particle& particle, StepFilter& filter) const;
  std::size_t rate_factor() const { return has_gyro_ ? inertial_smoother::kGyroOwn : inertial_smoother::kRateWalk; }
  void update(const Window& window, std::size_t e, StepFilter& filter);
  void normalise();
  void resample();
  void draw_scales(double part, Particle& particle);
  void walk(double interval_s);
  void append(const CausalFeed& feed, std::size_t e, const std::vector<Checkpoint>& before);

  const Calibration& calibration_;
  const FusedConfig& model_;
  ParticleConfig config_;
  Random random_;
  CausalMotion out_;
  std::vector<Particle> particles_;
  std::vector<double> weight_;
  bool has_gyro_ = true;
  bool scales_fixed_ = false;
  double poses_ = 0.0, wild_ = 0.0, least_effective_ = std::numeric_limits<double>::infinity(), resampled_ = 0.0;
};

void ParticleFilter::set(const Particle& particle, StepFilter& filter) const {
  filter.settings.process_scale = particle.process_scale;
  filter.settings.factors[rate_factor()] = particle.rate_scale;
}

// The factors of a particle that knows nothing of them, `part` of the logarithm's range for the first.
void ParticleFilter::draw_scales(double part, Particle& particle) {
  particle.process_scale = kLowestScale * std::pow(config_.largest_scale / kLowestScale, part);
  // A gyroscope's own noise is a floor; what its scale and axes are wrong by is noise where the probe turns.
  particle.rate_scale = has_gyro_ ? kLowestScale * std::pow(config_.largest_scale / kLowestScale, random_.uniform())
                                  : std::pow(10.0, random_.uniform(-3.0, 3.0));
}

void ParticleFilter::begin(const CausalFeed& feed) {
  const Window& window = feed.problem();
  has_gyro_ = feed.stream().has_gyro;
  scales_fixed_ = model_.process_noise_scale > 0.0;
  particles_.resize(static_cast<std::size_t>(config_.particles));
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    Particle& particle = particles_[i];
    particle.at.x = window.start;
    particle.at.P = window.start_covariance;
    particle.process_scale = window.process_scale;
    particle.rate_scale = window.factors[rate_factor()];
    if (scales_fixed_) continue;
    // Evenly over the logarithm, one in each stratum.
    const double part = (static_cast<double>(i) + random_.uniform()) / static_cast<double>(particles_.size());
    draw_scales(part, particle);
  }
  normalise();
}

void ParticleFilter::normalise() {
  double greatest = -std::numeric_limits<double>::infinity();
  for (const Particle& particle : particles_) greatest = std::max(greatest, particle.log_weight);
  if (!std::isfinite(greatest))
    throw Error("the trajectory's estimate is not finite: check the calibration's magnitudes");
  weight_.resize(particles_.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    particles_[i].log_weight -= greatest;
    weight_[i] = std::exp(particles_[i].log_weight);
    sum += weight_[i];
  }
  double squares = 0.0;
  for (double& w : weight_) {
    w /= sum;
    squares += w * w;
  }
  least_effective_ = std::min(least_effective_, 1.0 / squares);
}

// Each particle is updated with the pose of epoch e, or takes it for wild.
void ParticleFilter::update(const Window& window, std::size_t e, StepFilter& filter) {
  const auto& knot = window.knots[window.epochs[e].knot];
  const Pose& pose = window.poses[static_cast<std::size_t>(window.epochs[e].pose)];
  filter.settings.gate_innovations = false;
  filter.settings.gate_chi2 = kUngated;
  ++poses_;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    Particle& particle = particles_[i];
    set(particle, filter);
    const inertial_smoother::Filtered good = filter.update(e, particle.at);
    const double chance_wild = particle.wild ? config_.wild_goes_on : config_.wild_begins;
    double log_good = std::log1p(-chance_wild) + good.log_likelihood - 3.0 * kLogTwoPi;
    double share_wild = 0.0;
    if (chance_wild > 0.0) {
      const inertial_smoother::Nominal& x = particle.at.x;
      const Vector3d omega = inertial_smoother::mounting_of(x, window).gyro * knot.w - x.bg;
      const auto y = inertial_smoother::predict_pose(x, omega, pose).residual;
      const double p2 = config_.wild_position_m * config_.wild_position_m;
      const double r2 = config_.wild_rotation_rad * config_.wild_rotation_rad;
      const double log_wild = std::log(chance_wild) - 3.0 * kLogTwoPi - 1.5 * std::log(p2 * r2) -
                              0.5 * (y.head<3>().squaredNorm() / p2 + y.tail<3>().squaredNorm() / r2);
      const double top = std::max(log_good, log_wild);
      const double both = top + std::log(std::exp(log_good - top) + std::exp(log_wild - top));
      share_wild = std::exp(log_wild - both);
      log_good = both;
    }
    particle.log_weight += log_good;
    particle.wild = share_wild > 0.0 && random_.chance(share_wild);
    if (!particle.wild) particle.at = good.checkpoint;
  }
  normalise();
  for (std::size_t i = 0; i < particles_.size(); ++i) wild_ += particles_[i].wild ? weight_[i] : 0.0;
  double squares = 0.0;
  for (const double w : weight_) squares += w * w;
  if (1.0 / squares < 0.5 * static_cast<double>(particles_.size())) resample();
}

// Systematic: one uniform number, evenly spaced heirs.
void ParticleFilter::resample() {
  const double step = 1.0 / static_cast<double>(particles_.size());
  double want = step * random_.uniform();
  double reached = 0.0;
  std::vector<Particle> heirs;
  heirs.reserve(particles_.size());
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    reached += weight_[i];
    for (; want < reached && heirs.size() < particles_.size(); want += step) heirs.push_back(particles_[i]);
  }
  while (heirs.size() < particles_.size()) heirs.push_back(particles_.back());  // the sum fell short by rounding
  particles_ = std::move(heirs);
  for (Particle& particle : particles_) particle.log_weight = 0.0;
  weight_.assign(particles_.size(), step);
  ++resampled_;
}

void ParticleFilter::walk(double interval_s) {
  if (scales_fixed_) return;
  const double size = config_.scale_walk_per_rts * std::sqrt(interval_s);
  for (Particle& particle : particles_) {
    if (random_.chance(config_.scale_jumps_Hz * interval_s)) draw_scales(random_.uniform(), particle);
    particle.process_scale = std::clamp(particle.process_scale * std::exp(size * random_.normal()), kLowestScale, 1e6);
    particle.rate_scale =
        std::clamp(particle.rate_scale * std::exp(size * random_.normal()), has_gyro_ ? kLowestScale : 1e-4, 1e6);
  }
}

// The samples of the interval before epoch e: the mean over the particles.
void ParticleFilter::append(const CausalFeed& feed, std::size_t e, const std::vector<Checkpoint>& before) {
  const Window& window = feed.problem();
  const Vector3d& tip_m = calibration_.tip_in_marker_m;
  std::vector<std::vector<PointState>> paths;
  Matrix3d begin_m2 = Matrix3d::Zero(), end_m2 = Matrix3d::Zero();
  double latency_s = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    paths.push_back(inertial_smoother::dead_reckon(window, e, particles_[i].at.x, tip_m));
    begin_m2 += weight_[i] * inertial_smoother::tip_covariance(particles_[i].at, window, tip_m);
    end_m2 += weight_[i] * inertial_smoother::tip_covariance(before[i], window, tip_m);
    latency_s += weight_[i] * particles_[i].at.x.latency;
  }
  const auto first = static_cast<std::size_t>(std::max_element(weight_.begin(), weight_.end()) - weight_.begin());
  std::vector<PointState> mean = paths[first];
  std::vector<Matrix3d> spread_m2(mean.size(), Matrix3d::Zero());
  for (std::size_t k = 0; k < mean.size(); ++k) {
    const PointState about = mean[k];
    const auto average = [&](Vector3d PointState::*field) {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t i = 0; i < paths.size(); ++i) sum += weight_[i] * (paths[i][k].*field - about.*field);
      mean[k].*field += sum;
    };
    for (const auto field :
         {&PointState::p_m, &PointState::v_mps, &PointState::a_mps2, &PointState::omega_radps, &PointState::arm_m}) {
      average(field);
    }
    Vector3d turn = Vector3d::Zero();
    const Vector3d tip = mean[k].p_m + mean[k].arm_m;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      turn += weight_[i] * log_rotation(paths[i][k].q_world_marker * about.q_world_marker.conjugate());
      const Vector3d d = paths[i][k].p_m + paths[i][k].arm_m - tip;
      spread_m2[k] += weight_[i] * d * d.transpose();
    }
    mean[k].q_world_marker = (exp_rotation(turn) * about.q_world_marker).normalized();
  }
  out_.append(feed, e, mean, begin_m2, end_m2, spread_m2, latency_s);
}

void ParticleFilter::run(const CausalFeed& feed, bool output) {
  const Window& window = feed.problem();
  StepFilter filter(window);
  if (window.epochs.front().pose >= 0) update(window, 0, filter);
  std::vector<Checkpoint> before(particles_.size());
  for (std::size_t e = 1; e < window.epochs.size(); ++e) {
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      set(particles_[i], filter);
      before[i] = filter.predict(e, particles_[i].at);
    }
    if (output) append(feed, e, before);
    for (std::size_t i = 0; i < particles_.size(); ++i) particles_[i].at = before[i];
    if (window.epochs[e].pose >= 0) update(window, e, filter);
    walk(window.knots[window.epochs[e].knot].t - window.knots[window.epochs[e - 1].knot].t);
  }
}

TrajectoryResult ParticleFilter::result() {
  TrajectoryResult out;
  out.motion = std::move(out_.motion);
  const bool finite = std::all_of(out.motion.p_world_tip_m.begin(), out.motion.p_world_tip_m.end(),
                                  [](const Vector3d& p) { return p.allFinite(); });
  if (!finite) throw Error("the trajectory's estimate is not finite: check the calibration's magnitudes");
  if (out.motion.size() == 0) throw Error("tracker.csv: the poses end before the filter has begun");
  double log_scale = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) log_scale += weight_[i] * std::log(particles_[i].process_scale);
  out.metrics["poses_used"] = poses_ - wild_;
  out.metrics["poses_wild"] = wild_;
  out.metrics["process_noise_scale"] = std::exp(log_scale);
  out.metrics["particles_effective_least"] = least_effective_;
  out.metrics["resampled"] = resampled_;
  return out;
}

}  // namespace

TrajectoryResult estimate_trajectory_particle(const Recording& recording, const FusedConfig& model,
                                              const ParticleConfig& config, const Observer& observer) {
  CausalFeed feed(recording, model, config.feed);
  ParticleFilter filter(recording, model, config);
  bool started = false;
  while (feed.next()) {
    if (!started) filter.begin(feed);
    filter.run(feed, started);
    started = true;
    observer.update("particles", static_cast<double>(feed.first_row()) / static_cast<double>(recording.probe.size()));
  }
  return filter.result();
}

}  // namespace asperity
