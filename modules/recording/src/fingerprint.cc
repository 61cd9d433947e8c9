#include "asperity/recording/fingerprint.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/radix_sort.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::size_t kProbeWindow = 32, kPoseWindow = 8;
constexpr double kSharedShare = 0.05;
constexpr std::size_t kStored = 32;  // hashes of a sketch in a file
constexpr std::size_t kDigits = 16;  // of a hash

// Steele, Lea and Flood's finaliser (splitmix64, OOPSLA 2014).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

class RowHash {
 public:
  void add(double value) {
    // One zero and one nan.
    const float rounded = std::isnan(value) ? std::nanf("") : static_cast<float>(value) + 0.0F;
    hash_ = mixed(hash_ ^ std::bit_cast<std::uint32_t>(rounded));
  }
  void add(const Eigen::Vector3d& values) {
    for (const double value : values) add(value);
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0;
};

SampleSketch sketch_rows(const std::vector<std::uint64_t>& rows, std::size_t window) {
  constexpr std::uint64_t kBase = 0x100000001b3ULL;
  std::uint64_t first_power = 1;
  for (std::size_t k = 0; k < window; ++k) first_power *= kBase;
  SampleSketch out;
  std::uint64_t rolling = 0;
  std::size_t alike = 0;  // rows up to here that are the same
  for (std::size_t i = 0; i < rows.size(); ++i) {
    alike = i > 0 && rows[i] == rows[i - 1] ? alike + 1 : 1;
    rolling = rolling * kBase + rows[i];
    if (i >= window) rolling -= first_power * rows[i - window];
    if (i + 1 >= window && alike < window) out.hashes.push_back(mixed(rolling));
  }
  radix_sort(out.hashes);
  out.hashes.erase(std::unique(out.hashes.begin(), out.hashes.end()), out.hashes.end());
  out.windows = out.hashes.size();
  return out;
}

SampleSketch sketch_probe(const ProbeStream& probe) {
  std::vector<std::uint64_t> rows(probe.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    RowHash row;
    row.add(probe.accel_counts[i]);
    row.add(probe.force_counts[i]);
    if (probe.has_gyro()) row.add(probe.gyro_counts[i]);
    if (!probe.force3_counts.empty()) row.add(probe.force3_counts[i]);
    rows[i] = row.value();
  }
  return sketch_rows(rows, kProbeWindow);
}

Json sketch_json(const SampleSketch& sketch) {
  std::string smallest;
  for (std::size_t i = 0; i < std::min(kStored, sketch.hashes.size()); ++i)
    smallest += fmt::format("{:016x}", sketch.hashes[i]);
  return {{"windows", sketch.windows}, {"smallest", smallest}};
}

SampleSketch parse_sketch(const Json& json, const char* name) {
  SampleSketch out;
  if (!json.is_object() || !json.contains(name) || !json.at(name).is_object()) return out;
  const Json& sketch = json.at(name);
  if (!sketch.contains("windows") || !sketch.at("windows").is_number() || !sketch.contains("smallest") ||
      !sketch.at("smallest").is_string()) {
    return out;
  }
  const auto digits = sketch.at("smallest").get<std::string>();
  for (std::size_t at = 0; at + kDigits <= digits.size() && out.hashes.size() < kStored; at += kDigits) {
    std::uint64_t hash = 0;
    const char* const end = digits.data() + at + kDigits;
    constexpr int kHexadecimal = 16;
    if (std::from_chars(digits.data() + at, end, hash, kHexadecimal).ptr != end) return {};
    out.hashes.push_back(hash);
  }
  if (!std::is_sorted(out.hashes.begin(), out.hashes.end())) return {};
  const auto windows = sketch.at("windows").get<double>();
  constexpr double kMost = 1e15;
  if (!(windows >= static_cast<double>(out.hashes.size())) || windows > kMost) return {};
  out.windows = static_cast<std::uint64_t>(windows);
  return out;
}

}  // namespace

Fingerprint fingerprint_of(const Recording& recording) {
  return {sketch_probe(recording.probe), sketch_poses(recording.tracker), {}};
}

SampleSketch sketch_poses(const TrackerStream& tracker) {
  std::vector<std::uint64_t> rows(tracker.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Pose& pose = tracker.T_world_marker[i];
    const double sign = pose.rotation.w() < 0.0 ? -1.0 : 1.0;
    RowHash row;
    row.add(pose.translation_m);
    for (const double q : pose.rotation.coeffs()) row.add(sign * q);
    rows[i] = row.value();
  }
  return sketch_rows(rows, kPoseWindow);
}

SampleSketch sketch_points(std::span<const Eigen::Vector3d> points) {
  std::vector<std::uint64_t> rows(points.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    RowHash row;
    row.add(points[i]);
    rows[i] = row.value();
  }
  return sketch_rows(rows, kPoseWindow);
}

SampleSketch sketch_values(std::span<const double> values) {
  std::vector<std::uint64_t> rows(values.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    RowHash row;
    row.add(values[i]);
    rows[i] = row.value();
  }
  return sketch_rows(rows, kProbeWindow);
}

double shared_share(const SampleSketch& a, const SampleSketch& b) {
  if (a.hashes.empty() || b.hashes.empty()) return 0.0;
  // Up to this hash both are known.
  std::uint64_t limit = ~std::uint64_t{0};
  if (!a.is_whole()) limit = std::min(limit, a.hashes.back());
  if (!b.is_whole()) limit = std::min(limit, b.hashes.back());
  const auto end_a = std::upper_bound(a.hashes.begin(), a.hashes.end(), limit);
  const auto end_b = std::upper_bound(b.hashes.begin(), b.hashes.end(), limit);
  const auto known = std::min(end_a - a.hashes.begin(), end_b - b.hashes.begin());
  if (known == 0) return 0.0;
  std::size_t common = 0;
  for (auto i = a.hashes.begin(), k = b.hashes.begin(); i != end_a && k != end_b;) {
    if (*i == *k) ++common;
    const bool first = *i <= *k, second = *k <= *i;
    if (first) ++i;
    if (second) ++k;
  }
  return static_cast<double>(common) / static_cast<double>(known);
}

double shared_share(const Fingerprint& a, const Fingerprint& b) {
  return std::max({shared_share(a.probe, b.probe), shared_share(a.poses, b.poses), shared_share(a.points, b.points)});
}

bool is_same_measurement(const Fingerprint& a, const Fingerprint& b) { return shared_share(a, b) > kSharedShare; }

void check_independent(std::span<const NamedFingerprint> scans) {
  constexpr std::size_t kName = 200;
  for (std::size_t k = 1; k < scans.size(); ++k) {
    for (std::size_t i = 0; i < k; ++i) {
      const Fingerprint& a = scans[i].of;
      const Fingerprint& b = scans[k].of;
      const char* of = "samples";
      double share = shared_share(a.probe, b.probe);
      if (const double poses = shared_share(a.poses, b.poses); poses > share) {
        share = poses;
        of = "poses";
      }
      if (const double points = shared_share(a.points, b.points); points > share) {
        share = points;
        of = "points";
      }
      if (share <= kSharedShare) continue;
      throw Error(
          fmt::format("{} and {} have {:.0f} % of their {} in common: they are one measurement and not two; "
                      "leave one of them out",
                      printable(scans[i].name, kName), printable(scans[k].name, kName),
                      std::max(1.0, std::floor(100.0 * share)), of));
    }
  }
}

Json fingerprint_json(const Fingerprint& fingerprint) {
  Json out = Json::object();
  if (fingerprint.probe.windows > 0) out["probe"] = sketch_json(fingerprint.probe);
  if (fingerprint.poses.windows > 0) out["poses"] = sketch_json(fingerprint.poses);
  if (fingerprint.points.windows > 0) out["points"] = sketch_json(fingerprint.points);
  return out;
}

Fingerprint parse_fingerprint(const Json& json) {
  return {parse_sketch(json, "probe"), parse_sketch(json, "poses"), parse_sketch(json, "points")};
}

}  // namespace asperity
