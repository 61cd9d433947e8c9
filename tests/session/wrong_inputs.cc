#include "wrong_inputs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "asperity/simulation/simulate_recording.h"

namespace asperity {

namespace {

using Damage = std::function<void(Recording&)>;

SimulationConfig bench(const std::string& surface, const std::string& probe, int seed) {
  SimulationConfig config = make_simulation_config(surface, probe);
  config.seed = seed;
  return config;
}

void each_pose(Recording& r, const std::function<Pose(const Pose&)>& change) {
  for (Pose& T_world_marker : r.tracker.T_world_marker) T_world_marker = change(T_world_marker);
}

void each_force(Recording& r, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& change) {
  const double least = r.info.adc_min, most = r.info.adc_max;
  for (Eigen::Vector3d& counts : r.probe.accel_counts) {
    const Eigen::Vector3d f_mps2 = r.calibration.accelerometer.specific_force_mps2(counts);
    counts = r.calibration.accelerometer.counts(change(f_mps2)).array().round().matrix();
    if (most > least) counts = counts.cwiseMax(least).cwiseMin(most);
  }
}

Damage tracker_late(double late_s) {
  return [late_s](Recording& r) {
    for (std::int64_t& t_ns : r.tracker.t_ns) t_ns += static_cast<std::int64_t>(std::llround(late_s * 1e9));
  };
}

// From the middle of the recording on: by `late_s`, and by `faster` of the time since then.
Damage tracker_late_from_middle(double late_s, double faster) {
  return [=](Recording& r) {
    const std::int64_t middle_ns = r.tracker.t_ns.front() + (r.tracker.t_ns.back() - r.tracker.t_ns.front()) / 2;
    for (std::int64_t& t_ns : r.tracker.t_ns) {
      if (t_ns < middle_ns) continue;
      t_ns += static_cast<std::int64_t>(std::llround(late_s * 1e9 + faster * static_cast<double>(t_ns - middle_ns)));
    }
  };
}

Damage poses(std::function<Pose(const Pose&)> change) {
  return [change = std::move(change)](Recording& r) { each_pose(r, change); };
}

Damage forces(std::function<Eigen::Vector3d(const Eigen::Vector3d&)> change) {
  return [change = std::move(change)](Recording& r) { each_force(r, change); };
}

Damage counts(std::function<Eigen::Vector3d(const Eigen::Vector3d&)> change) {
  return [change = std::move(change)](Recording& r) {
    for (Eigen::Vector3d& c : r.probe.accel_counts) c = change(c);
  };
}

Pose scaled(const Pose& T, const Eigen::Vector3d& factor) {
  Pose out = T;
  out.translation_m = T.translation_m.cwiseProduct(factor);
  return out;
}

// T with its axes exchanged in the translation alone, or with a basis change on both sides.
Pose exchanged(const Pose& T, const Eigen::Matrix3d& basis, bool rotation_too) {
  Pose out = T;
  out.translation_m = basis * T.translation_m;
  if (rotation_too) {
    const Eigen::Matrix3d R = basis * T.rotation.toRotationMatrix() * basis.transpose();
    out.rotation = Eigen::Quaterniond(R);
  }
  return out;
}

void keep_rows(Recording& r, std::size_t samples, std::size_t poses_kept) {
  r.probe.t_ns.resize(std::min(samples, r.probe.size()));
  const std::size_t n = r.probe.t_ns.size();
  r.probe.accel_counts.resize(n);
  r.probe.force_counts.resize(n);
  if (r.probe.has_gyro()) r.probe.gyro_counts.resize(n);
  if (!r.probe.force3_counts.empty()) r.probe.force3_counts.resize(n);
  const std::size_t m = std::min(poses_kept, r.tracker.size());
  r.tracker.t_ns.resize(m);
  r.tracker.T_world_marker.resize(m);
  for (auto* column : {&r.tracker.sigma_position_m, &r.tracker.sigma_rotation_rad, &r.tracker.noise_position_m,
                       &r.tracker.noise_rotation_rad}) {
    if (!column->empty()) column->resize(m);
  }
  if (!r.tracker.markers.empty()) r.tracker.markers.resize(m);
  if (!r.tracker.reprojection_px.empty()) r.tracker.reprojection_px.resize(m);
}

void force_is(Recording& r, const std::function<double(double t_s)>& force_N) {
  const ForceCalibration& c = r.calibration.force;
  for (std::size_t i = 0; i < r.probe.size(); ++i) {
    if (!std::isfinite(r.probe.force_counts[i])) continue;
    const double t_s = static_cast<double>(r.probe.t_ns[i] - r.probe.t_ns.front()) * 1e-9;
    r.probe.force_counts[i] = std::round((force_N(t_s) - c.offset_newton) / c.newton_per_count);
  }
}

// The standard deviation of each channel of the accelerometer, counts.
Eigen::Vector3d spread_of(const Recording& r) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = sum;
  for (const Eigen::Vector3d& c : r.probe.accel_counts) {
    sum += c;
    squares += c.cwiseAbs2();
  }
  const auto n = static_cast<double>(r.probe.size());
  return (squares / n - (sum / n).cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
}

void add_hum(Recording& r, double frequency_Hz, const Eigen::Vector3d& amplitude_counts) {
  for (std::size_t i = 0; i < r.probe.size(); ++i) {
    const double t_s = 1e-9 * static_cast<double>(r.probe.t_ns[i] - r.probe.t_ns.front());
    r.probe.accel_counts[i] += std::sin(2.0 * std::numbers::pi * frequency_Hz * t_s) * amplitude_counts;
  }
}

// Means over `width_s` about each sample, of as many samples as that is at the mean rate.
void smooth_counts(Recording& r, double width_s) {
  const double span_s = 1e-9 * static_cast<double>(r.probe.t_ns.back() - r.probe.t_ns.front());
  const auto reach = static_cast<std::size_t>(0.5 * width_s * static_cast<double>(r.probe.size()) / span_s);
  std::vector<Eigen::Vector3d> sums(r.probe.size() + 1, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < r.probe.size(); ++i) sums[i + 1] = sums[i] + r.probe.accel_counts[i];
  for (std::size_t i = 0; i < r.probe.size(); ++i) {
    const std::size_t first = i < reach ? 0 : i - reach, last = std::min(i + reach + 1, r.probe.size());
    const Eigen::Vector3d mean = (sums[last] - sums[first]) / static_cast<double>(last - first);
    r.probe.accel_counts[i] = mean.array().round().matrix();
  }
}

}  // namespace

std::vector<WrongInput> wrong_inputs(const std::string& surface, const std::string& probe, int seed) {
  SimulationConfig config = bench(surface, probe, seed);
  Recording good = simulate_recording(config);
  std::vector<WrongInput> out;
  const auto add = [&](const char* group, const char* what, Damage damage) {
    out.push_back({group, what, [good, damage = std::move(damage)] {
                     Recording r = good;
                     damage(r);
                     return r;
                   }});
  };
  add("clock", "tracker 0.1 s late", tracker_late(0.1));
  add("clock", "tracker 0.1 s early", tracker_late(-0.1));
  add("clock", "tracker 20 ms late", tracker_late(0.02));
  add("clock", "tracker 20 ms early", tracker_late(-0.02));
  add("clock", "tracker 5 ms late", tracker_late(0.005));
  add("clock", "tracker 5 ms early", tracker_late(-0.005));
  add("clock", "tracker 50 ms later from the middle on", tracker_late_from_middle(0.05, 0.0));
  add("clock", "tracker 3 % fast from the middle on", tracker_late_from_middle(0.0, 0.03));

  Eigen::Matrix3d swap_xy;
  swap_xy << 0, 1, 0, 1, 0, 0, 0, 0, 1;
  add("tracker", "x and y of the position exchanged",
      poses([=](const Pose& T) { return exchanged(T, swap_xy, false); }));
  add("tracker", "x and y of position and rotation exchanged",
      poses([=](const Pose& T) { return exchanged(T, swap_xy, true); }));
  add("tracker", "z of the position negative", poses([](const Pose& T) { return scaled(T, {1, 1, -1}); }));
  add("tracker", "x of the position negative", poses([](const Pose& T) { return scaled(T, {-1, 1, 1}); }));
  add("tracker", "other handedness (z mirrored)",
      poses([](const Pose& T) { return exchanged(T, Eigen::Vector3d(1, 1, -1).asDiagonal(), true); }));
  add("tracker", "quaternion as x, y, z, w", poses([](const Pose& T) {
        Pose o = T;
        o.rotation = Eigen::Quaterniond(T.rotation.x(), T.rotation.y(), T.rotation.z(), T.rotation.w());
        return o;
      }));
  add("tracker", "quaternion conjugated", poses([](const Pose& T) {
        Pose o = T;
        o.rotation = T.rotation.conjugate();
        return o;
      }));
  add("tracker", "pose inverted (marker from world)", poses([](const Pose& T) { return T.inverse(); }));
  add("tracker", "scale 1.05", poses([](const Pose& T) { return scaled(T, Eigen::Vector3d::Constant(1.05)); }));
  add("tracker", "scale 0.95", poses([](const Pose& T) { return scaled(T, Eigen::Vector3d::Constant(0.95)); }));
  add("tracker", "inches as centimetres (scale 0.394)",
      poses([](const Pose& T) { return scaled(T, Eigen::Vector3d::Constant(1 / 2.54)); }));
  add("tracker", "mm as m", poses([](const Pose& T) { return scaled(T, Eigen::Vector3d::Constant(1000)); }));
  add("tracker", "the same pose throughout", [](Recording& r) {
    for (Pose& T : r.tracker.T_world_marker) T = r.tracker.T_world_marker.front();
  });
  add("tracker", "each pose four times", [](Recording& r) {
    for (std::size_t i = 0; i < r.tracker.size(); ++i)
      r.tracker.T_world_marker[i] = r.tracker.T_world_marker[i / 4 * 4];
  });
  add("tracker", "the same pose for a fifth of the scan", [](Recording& r) {
    const std::size_t first = 2 * r.tracker.size() / 5;
    for (std::size_t i = first; i < first + r.tracker.size() / 5; ++i)
      r.tracker.T_world_marker[i] = r.tracker.T_world_marker[first];
  });
  add("tracker", "noise in place of poses", [](Recording& r) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> n;
    for (Pose& T : r.tracker.T_world_marker) {
      T.translation_m =
          r.tracker.T_world_marker.front().translation_m + 1e-3 * Eigen::Vector3d(n(random), n(random), n(random));
    }
  });
  add("tracker", "of another scan", [config](Recording& r) {
    SimulationConfig other = config;
    other.seed += 77;
    const Recording o = simulate_recording(other);
    for (std::size_t i = 0; i < r.tracker.size(); ++i)
      r.tracker.T_world_marker[i] = o.tracker.T_world_marker[std::min(i, o.tracker.size() - 1)];
  });

  using V = Eigen::Vector3d;
  add("accelerometer", "x and y exchanged", forces([](const V& f) { return V(f.y(), f.x(), f.z()); }));
  add("accelerometer", "axes turned in a circle", forces([](const V& f) { return V(f.z(), f.x(), f.y()); }));
  add("accelerometer", "x and z exchanged", forces([](const V& f) { return V(f.z(), f.y(), f.x()); }));
  add("accelerometer", "x negative", forces([](const V& f) { return V(-f.x(), f.y(), f.z()); }));
  add("accelerometer", "y negative", forces([](const V& f) { return V(f.x(), -f.y(), f.z()); }));
  add("accelerometer", "z negative", forces([](const V& f) { return V(f.x(), f.y(), -f.z()); }));
  add("accelerometer", "all negative", forces([](const V& f) { return V(-f); }));
  add("accelerometer", "in g instead of m/s²", forces([](const V& f) { return V(f / 9.80665); }));
  add("accelerometer", "without gravity", [](Recording& r) {
    std::size_t pose = 0;
    for (std::size_t i = 0; i < r.probe.size(); ++i) {
      while (pose + 1 < r.tracker.size() && r.tracker.t_ns[pose + 1] < r.probe.t_ns[i]) ++pose;
      const V g_mps2 = r.tracker.T_world_marker[pose].rotation.conjugate() * r.info.gravity_world_mps2;
      const AccelerometerCalibration& c = r.calibration.accelerometer;
      r.probe.accel_counts[i] = c.counts(c.specific_force_mps2(r.probe.accel_counts[i]) + g_mps2);
    }
  });
  add("accelerometer", "scale 1.1", forces([](const V& f) { return V(1.1 * f); }));
  add("accelerometer", "scale 0.9", forces([](const V& f) { return V(0.9 * f); }));
  add("accelerometer", "x twice (in place of y)", counts([](const V& f) { return V(f.x(), f.x(), f.z()); }));
  add("accelerometer", "x twice (in place of z)", counts([](const V& f) { return V(f.x(), f.y(), f.x()); }));
  add("accelerometer", "y twice (in place of x)", counts([](const V& f) { return V(f.y(), f.y(), f.z()); }));
  add("accelerometer", "z dead", [](Recording& r) {
    const double z = r.probe.accel_counts.front().z();
    for (V& c : r.probe.accel_counts) c.z() = z;
  });
  add("accelerometer", "constant", [](Recording& r) {
    const V c0 = r.probe.accel_counts.front();
    for (V& c : r.probe.accel_counts) c = c0;
  });
  add("accelerometer", "each value ten times", [](Recording& r) {
    for (std::size_t i = 0; i < r.probe.size(); ++i) r.probe.accel_counts[i] = r.probe.accel_counts[i / 10 * 10];
  });
  add("accelerometer", "noise", [](Recording& r) {
    std::mt19937_64 random(2);
    std::normal_distribution<double> n;
    each_force(r, [&](const V& f) { return V(V(n(random), n(random), n(random)) * 5.0 + 0.0 * f); });
  });
  add("accelerometer", "hum of 60 Hz, as strong as the motion", [](Recording& r) { add_hum(r, 60.0, spread_of(r)); });
  add("accelerometer", "smoothed over 0.1 s", [](Recording& r) { smooth_counts(r, 0.1); });
  add("accelerometer", "smoothed over 0.1 s, with hum of 60 Hz", [](Recording& r) {
    const V amplitude_counts = 2.0 * spread_of(r);
    smooth_counts(r, 0.1);
    add_hum(r, 60.0, amplitude_counts);
  });
  add("accelerometer", "gravity alone (motion missing)", [](Recording& r) {
    V mean = V::Zero();
    for (const V& c : r.probe.accel_counts) mean += c / static_cast<double>(r.probe.size());
    std::mt19937_64 random(3);
    std::normal_distribution<double> n;
    for (V& c : r.probe.accel_counts) c = (mean + V(n(random), n(random), n(random))).array().round().matrix();
  });
  add("gyroscope", "x and y exchanged", [](Recording& r) {
    for (V& c : r.probe.gyro_counts) std::swap(c.x(), c.y());
  });
  add("gyroscope", "y and z exchanged", [](Recording& r) {
    for (V& c : r.probe.gyro_counts) std::swap(c.y(), c.z());
  });
  add("gyroscope", "negative", [](Recording& r) {
    if (!r.calibration.gyroscope) return;
    const V C = r.calibration.gyroscope->C;
    for (V& c : r.probe.gyro_counts) c = 2 * C - c;
  });
  add("gyroscope", "in degrees", [](Recording& r) {
    if (!r.calibration.gyroscope) return;
    const V C = r.calibration.gyroscope->C;
    for (V& c : r.probe.gyro_counts) c = C + (c - C) * 57.2957795;
  });

  add("contact", "force never touches", [](Recording& r) { force_is(r, [](double) { return 0.0; }); });
  add("contact", "force noise of 20 mN in the air", [](Recording& r) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> n;
    force_is(r, [&](double) { return 0.02 * n(random); });
  });
  add("contact", "force noise of 0.2 N in the air", [](Recording& r) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> n;
    force_is(r, [&](double) { return 0.2 * n(random); });
  });
  add("contact", "touched for 0.2 s, then air",
      [](Recording& r) { force_is(r, [](double t_s) { return t_s < 0.2 ? 1.0 : 0.0; }); });
  add("contact", "touched for 0.2 s on the way",
      [](Recording& r) { force_is(r, [](double t_s) { return t_s > 1.5 && t_s < 1.7 ? 1.0 : 0.0; }); });
  add("contact", "pressed and not moved", [config](Recording& r) {
    const Recording full = simulate_recording(config);
    std::size_t samples = 0, kept = 0;
    const std::int64_t end = r.probe.t_ns.front() + 450'000'000;
    while (samples < r.probe.size() && r.probe.t_ns[samples] < end) ++samples;
    while (kept < r.tracker.size() && r.tracker.t_ns[kept] < end) ++kept;
    keep_rows(r, samples, kept);
  });
  add("contact", "pressed for 4 s and not moved", [config](Recording& r) {
    SimulationConfig still = config;
    still.hand.rest_s = 4.0;
    Recording o = simulate_recording(still);
    r = o;
    std::size_t samples = 0, kept = 0;
    const std::int64_t end = r.probe.t_ns.front() + 3'900'000'000;
    while (samples < r.probe.size() && r.probe.t_ns[samples] < end) ++samples;
    while (kept < r.tracker.size() && r.tracker.t_ns[kept] < end) ++kept;
    keep_rows(r, samples, kept);
  });
  add("file", "five samples, two poses", [](Recording& r) { keep_rows(r, 5, 2); });
  add("file", "50 samples", [](Recording& r) { keep_rows(r, 50, 20); });
  add("file", "0.6 s alone", [](Recording& r) {
    std::size_t samples = 0, kept = 0;
    const std::int64_t end = r.probe.t_ns.front() + 600'000'000;
    while (samples < r.probe.size() && r.probe.t_ns[samples] < end) ++samples;
    while (kept < r.tracker.size() && r.tracker.t_ns[kept] < end) ++kept;
    keep_rows(r, samples, kept);
  });
  add("file", "all values constant", [](Recording& r) {
    for (V& c : r.probe.accel_counts) c = r.probe.accel_counts.front();
    for (double& c : r.probe.force_counts) c = r.probe.force_counts.front();
    for (V& c : r.probe.gyro_counts) c = r.probe.gyro_counts.front();
    for (Pose& T : r.tracker.T_world_marker) T = r.tracker.T_world_marker.front();
  });
  add("file", "two scans one after another", [config](Recording& r) {
    SimulationConfig other = config;
    other.seed += 5;
    other.hand.tilt_rad = {-0.2, 0.4, 0.3};
    Recording o = simulate_recording(other);
    const std::int64_t shift = std::max(r.probe.t_ns.back(), r.tracker.t_ns.back()) + 8'000'000 -
                               std::min(o.probe.t_ns.front(), o.tracker.t_ns.front());
    for (std::size_t i = 0; i < o.probe.size(); ++i) {
      r.probe.t_ns.push_back(o.probe.t_ns[i] + shift);
      r.probe.accel_counts.push_back(o.probe.accel_counts[i]);
      r.probe.force_counts.push_back(o.probe.force_counts[i]);
      if (r.probe.has_gyro()) r.probe.gyro_counts.push_back(o.probe.gyro_counts[i]);
    }
    for (std::size_t i = 0; i < o.tracker.size(); ++i) {
      r.tracker.t_ns.push_back(o.tracker.t_ns[i] + shift);
      Pose T = o.tracker.T_world_marker[i];
      T.translation_m += V(0.02, 0.01, 0.01);
      r.tracker.T_world_marker.push_back(T);
      if (!r.tracker.markers.empty()) r.tracker.markers.push_back(o.tracker.markers[i]);
      if (!r.tracker.reprojection_px.empty()) r.tracker.reprojection_px.push_back(o.tracker.reprojection_px[i]);
    }
    r.info.segments.front().end_ns = r.probe.t_ns.back();
  });
  return out;
}

}  // namespace asperity
