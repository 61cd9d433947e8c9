#include "check_rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <Eigen/LU>
#include <Eigen/SVD>
#include "asperity/base/error.h"
#include "axes_choice.h"
#include "check_lengths.h"
#include "pair_rates.h"

namespace asperity {

namespace {

constexpr double kSameMotion = 0.8;  // a cosine above: the same rotation
constexpr double kOtherFits = 0.9;   // a cosine above: what is tried instead explains it
constexpr double kLeastCentred_radps = 0.05;
constexpr std::size_t kLeastPairs = 20;

struct Agreement {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();  // Σ ω_p ω_gᵀ
  double pose2 = 0.0;                                // without the share of the poses' noise
  double gyro2 = 0.0;
  double gyro_changes2 = 0.0;  // without the mean
  double noise2 = 0.0;
  double length_cosine = 0.0;  // of the centred lengths
  std::size_t pairs = 0;
  bool centred = false;  // without the means, which a gyroscope's offset is in
  double stretch_s = 0.0;
  double pose_noise_rad = 0.0;

  double cosine(const Eigen::Matrix3d& R) const {
    const double both = std::sqrt(std::max(pose2, 0.0) * gyro2);
    return both > 0.0 ? std::clamp((R.transpose() * moment).trace() / both, -1.0, 1.0) : 0.0;
  }
  double pose_rms_radps() const {
    return std::sqrt(std::max(pose2, 0.0) / static_cast<double>(std::max<std::size_t>(pairs, 1)));
  }
  double signal_to_noise() const { return noise2 > 0.0 ? pose2 / noise2 : HUGE_VAL; }
  // Standard error of the cosine and, relative, of the ratio: by the noise in the products, by its own chance in the
  // poses' power, and by what its share may be wrong by.
  double error() const {
    if (!(noise2 > 0.0) || !(pose2 > 0.0)) return 0.0;
    constexpr double kShareError = 0.1;
    const double n = 3.0 * static_cast<double>(pairs), ratio = signal_to_noise();
    return std::hypot(1.0 / std::sqrt(n * ratio), std::sqrt(0.5 / n) / ratio, kShareError / ratio);
  }
};

Agreement agreement_of(const RatePairs& pairs) {
  Agreement out;
  out.pairs = pairs.pose_radps.size();
  out.stretch_s = pairs.stretch_s;
  out.pose_noise_rad = pairs.pose_noise_rad;
  out.noise2 = pairs.noise2;
  double sum_p = 0.0, sum_g = 0.0, product = 0.0;
  Eigen::Vector3d total_p = Eigen::Vector3d::Zero(), total_g = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < out.pairs; ++i) {
    const auto &p = pairs.pose_radps[i], &g = pairs.gyro_radps[i];
    out.moment += p * g.transpose();
    out.pose2 += p.squaredNorm();
    out.gyro2 += g.squaredNorm();
    total_p += p;
    total_g += g;
    sum_p += p.norm();
    sum_g += g.norm();
    product += p.norm() * g.norm();
  }
  const double n = static_cast<double>(out.pairs);
  const double spread = (out.pose2 - sum_p * sum_p / n) * (out.gyro2 - sum_g * sum_g / n);
  if (out.pairs > 2 && spread > 0.0) out.length_cosine = (product - sum_p * sum_g / n) / std::sqrt(spread);
  if (out.pairs > 0) out.gyro_changes2 = out.gyro2 - total_g.squaredNorm() / n;
  out.pose2 -= out.noise2;
  // A gyroscope's offset is in the means alone; a steady rotation is too.
  if (out.pairs > 0 && (out.pose2 - total_p.squaredNorm() / n) / n > kLeastCentred_radps * kLeastCentred_radps) {
    out.moment -= total_p * total_g.transpose() / n;
    out.pose2 -= total_p.squaredNorm() / n;
    out.gyro2 -= total_g.squaredNorm() / n;
    out.centred = true;
  }
  return out;
}

AxesChoice best_axes(const Agreement& agreement, double determinant) {
  const auto all = all_axes(determinant);
  return *std::max_element(all.begin(), all.end(), [&](const AxesChoice& a, const AxesChoice& b) {
    return agreement.cosine(a.R) < agreement.cosine(b.R);
  });
}

// Kabsch 1976: the rotation that brings the gyroscope's vectors nearest to the poses'.
Eigen::Matrix3d fitted_rotation(const Agreement& agreement) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(agreement.moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

PoseStream with_rotations(const PoseStream& pose,
                          const std::function<Eigen::Quaterniond(const Eigen::Quaterniond&)>& change) {
  PoseStream out = pose;
  for (Pose& T : out.T_world_body) T.rotation = change(T.rotation);
  return out;
}

// What else the poses' rotations may be.
struct OtherRotation {
  std::string message;
  StatedSetting setting;
  Eigen::Quaterniond (*change)(const Eigen::Quaterniond&);
};

const std::array<OtherRotation, 3>& other_rotations() {
  static const std::array<OtherRotation, 3> kOthers{{
      // The cells c0 … c3 that were read as w, x, y, z are x, y, z, w.
      {"the order of its cells is x, y, z, w",
       {"mapping.quaternion", "xyzw"},
       [](const Eigen::Quaterniond& q) { return Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()); }},
      {"the order of its cells is w, x, y, z",
       {"mapping.quaternion", "wxyz"},
       [](const Eigen::Quaterniond& q) { return Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()); }},
      {"the rotations are from the world to the body",
       {"mapping.invert_rotation", "true"},
       [](const Eigen::Quaterniond& q) { return q.conjugate(); }},
  }};
  return kOthers;
}

ImportDoubt rotated_sensor(const Eigen::Matrix3d& R, const StreamUnits& units) {
  return {ColumnGroup::kRate,
          FileRole::kImu,
          fmt::format("the gyroscope's axes are not the body's: they are rotated by {:.1f}° against them",
                      Eigen::AngleAxisd(R).angle() * 57.29577951308232),
          {},
          {{"mapping.imu_axes", axes_text(R * units.sensor_axes)}}};
}

// A sensor whose axes are exchanged by R, or mirrored by −R: mirrored rates change their sign, so that both rotate
// alike. The accelerometer shows which it is.
ImportDoubt exchanged_sensor(const ImportStreams& streams, const StreamUnits& units, const Eigen::Matrix3d& R) {
  const bool is_mirrored = length_cosine(streams, -R) > kSameMotion;
  const Eigen::Matrix3d axes = is_mirrored ? -R : R;
  return {ColumnGroup::kRate,
          FileRole::kImu,
          "the gyroscope's axes are not the body's: the body's x, y, z look like its " + axes_text(R) +
              (is_mirrored ? ", and like the accelerometer's " + axes_text(axes) : std::string()),
          {},
          {{"mapping.imu_axes", axes_text(axes * units.sensor_axes)}},
          {}};
}

ImportDoubt explain_difference(const ImportStreams& streams, const StreamUnits& units, const Agreement& agreement) {
  for (const OtherRotation& other : other_rotations()) {
    const Agreement changed = agreement_of(pair_rates(with_rotations(streams.pose, other.change), streams.rate));
    if (changed.cosine(Eigen::Matrix3d::Identity()) < kOtherFits) continue;
    return {ColumnGroup::kRotation,
            FileRole::kPose,
            "the poses and the gyroscope show different rotations; they agree if " + other.message,
            {},
            {other.setting}};
  }
  const AxesChoice exchanged = best_axes(agreement, 1.0);
  if (agreement.cosine(exchanged.R) > kOtherFits) return exchanged_sensor(streams, units, exchanged.R);
  const AxesChoice mirrored = best_axes(agreement, -1.0);
  if (agreement.cosine(mirrored.R) > kOtherFits) {
    return {
        ColumnGroup::kRate,
        FileRole::kImu,
        "the gyroscope shows the mirror image of the poses' rotation: two of its columns are exchanged, or a sign is "
        "wrong; they agree if x, y, z are its " +
            mirrored.name(),
        {},
        {},
        mirrored.name()};
  }
  const Eigen::Matrix3d R = fitted_rotation(agreement);
  if (agreement.cosine(R) > kOtherFits) return rotated_sensor(R, units);
  return {
      ColumnGroup::kRotation,
      FileRole::kPose,
      fmt::format("the poses and the gyroscope do not show the same rotation (cosine {:.2f}): other columns, another "
                  "order of the quaternion or of Euler angles, or clocks that differ",
                  agreement.cosine(Eigen::Matrix3d::Identity())),
      {},
      {}};
}

}  // namespace

std::string unit_for_ratio(const std::string& unit, Quantity quantity, double ratio, double tolerance) {
  const auto read = find_import_unit(unit, quantity);
  if (!read || !(ratio > 0.0)) return {};
  std::string best;
  double least = std::log(tolerance);
  std::string names = import_unit_names(quantity) + ",";
  for (std::size_t comma = names.find(','); comma != std::string::npos; comma = names.find(',')) {
    const std::string name = names.substr(names.find_first_not_of(' '), comma - names.find_first_not_of(' '));
    names.erase(0, comma + 1);
    const auto other = find_import_unit(name, quantity);
    if (!other || other->is_date || other->factor == read->factor) continue;
    const double away = std::abs(std::log(ratio * other->factor / read->factor));
    if (away < least) least = away, best = name;
  }
  return best;
}

namespace {

enum class Shown { kEnough, kTooLittle, kNoise };

Shown shown_by(const Agreement& agreement) {
  constexpr double kLeast_radps = 0.1, kLeastOverNoise = 3.0;
  if (agreement.pairs < kLeastPairs) return Shown::kTooLittle;
  if (agreement.signal_to_noise() < kLeastOverNoise) return Shown::kNoise;
  return agreement.pose_rms_radps() >= (agreement.centred ? kLeastCentred_radps : kLeast_radps) ? Shown::kEnough
                                                                                                : Shown::kTooLittle;
}

}  // namespace

double rotation_cosine(const PoseStream& pose, const VectorStream& rate) {
  const Agreement agreement = agreement_of(pair_rates(pose, rate));
  if (shown_by(agreement) != Shown::kEnough) return 0.0;
  return std::min(agreement.cosine(Eigen::Matrix3d::Identity()), 1.0 - 2.0 * agreement.error());
}

void check_rotation(const ImportStreams& streams, const StreamUnits& units, StreamChecks& out) {
  if (streams.rate.size() < 2 || streams.pose.size() < 2) return;
  const Agreement agreement = agreement_of(pair_rates(streams.pose, streams.rate));
  out.pose_noise_rad = agreement.pose_noise_rad;
  constexpr double kNoOrientation_rad = 0.1;
  const Shown shown = shown_by(agreement);
  if (shown != Shown::kEnough && agreement.pose_noise_rad > kNoOrientation_rad) {
    out.doubts.push_back({ColumnGroup::kRotation,
                          FileRole::kPose,
                          fmt::format("the rotation scatters by {:.2g} rad from one pose to the next: other columns, "
                                      "another unit of the angles, or another order",
                                      agreement.pose_noise_rad),
                          {},
                          {}});
    return;
  }
  // Ten times the power of all that the poses show, with their noise: a rotation that they would show.
  constexpr double kFarMore = 10.0, kSeen_radps = 0.1;
  const double n = static_cast<double>(std::max<std::size_t>(agreement.pairs, 1));
  if (shown != Shown::kEnough && agreement.pairs >= kLeastPairs &&
      agreement.gyro_changes2 > n * kSeen_radps * kSeen_radps &&
      agreement.gyro_changes2 > kFarMore * (std::max(agreement.pose2, 0.0) + agreement.noise2)) {
    out.doubts.push_back({ColumnGroup::kRotation,
                          FileRole::kPose,
                          fmt::format("the gyroscope shows a rotation of {:.2g} rad/s, the poses almost none: other "
                                      "columns, another unit of the angles, or a gyroscope in counts",
                                      std::sqrt(agreement.gyro_changes2 / n)),
                          {},
                          {}});
    return;
  }
  if (shown == Shown::kTooLittle) {
    out.notes.push_back("gyroscope and poses: not compared, for there is too little rotation");
    return;
  }
  if (shown == Shown::kNoise) {
    out.notes.push_back(
        fmt::format("gyroscope and poses: whether they show the same rotation is not determined, for the poses' "
                    "rotation is not above their noise of {:.2g} mrad",
                    1e3 * agreement.pose_noise_rad));
    return;
  }
  out.rate_ratio = std::sqrt(agreement.gyro2 / agreement.pose2);
  out.rate_cosine = agreement.cosine(Eigen::Matrix3d::Identity());
  out.rate_stretch_s = agreement.stretch_s;
  const double within = 2.0 * agreement.error();
  const double tolerance = 1.15 * (1.0 + within);
  const bool same_size = out.rate_ratio < tolerance && out.rate_ratio > 1.0 / tolerance;
  constexpr double kRelated = 0.6;
  if (!same_size && (agreement.length_cosine > kRelated || out.rate_cosine > kSameMotion)) {
    const std::string unit = unit_for_ratio(units.rate, Quantity::kRate, out.rate_ratio, tolerance);
    out.doubts.push_back({ColumnGroup::kRate,
                          FileRole::kImu,
                          unit.empty()
                              ? fmt::format("the gyroscope shows {:.4g} times the rotation of the poses: it looks "
                                            "like counts",
                                            out.rate_ratio)
                              : fmt::format("the gyroscope shows {:.4g} times the rotation of the poses: this "
                                            "looks like {}",
                                            out.rate_ratio, unit),
                          unit,
                          {}});
    return;
  }
  if (out.rate_cosine < kSameMotion) {
    if (out.rate_cosine + within < kSameMotion) {
      out.doubts.push_back(explain_difference(streams, units, agreement));
    } else {
      out.notes.push_back(
          fmt::format("gyroscope and poses: whether they show the same rotation is not determined (cosine {:.2f} ± "
                      "{:.2f})",
                      out.rate_cosine, agreement.error()));
    }
    return;
  }
  // Axes near the body's are how a sensor is mounted. Far from them, a rotation that explains most of the difference is
  // an error of the mapping.
  const Eigen::Matrix3d R = fitted_rotation(agreement);
  constexpr double kFar_rad = 0.17, kExplained = 0.25;
  if (Eigen::AngleAxisd(R).angle() > kFar_rad &&
      1.0 - agreement.cosine(R) + within < kExplained * (1.0 - out.rate_cosine)) {
    out.doubts.push_back(rotated_sensor(R, units));
  }
}

}  // namespace asperity
