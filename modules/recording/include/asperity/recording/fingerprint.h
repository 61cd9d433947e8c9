#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "asperity/json/json.h"
#include "asperity/recording/recording.h"

namespace asperity {

// Which rows a table holds, wherever they are in it: the hashes of its windows of consecutive rows (Broder, "On the
// resemblance and containment of documents", SEQUENCES 1997). Windows whose rows are all alike are left out.
struct SampleSketch {
  std::uint64_t windows = 0;          // distinct ones
  std::vector<std::uint64_t> hashes;  // their hashes, rising; all, or the smallest

  bool is_whole() const { return hashes.size() == windows; }
};

// What was measured, by the values alone: times, names, calibration and other metadata are not in it. Values count to
// the 24 bits of a float, so that a copy written with other digits is a copy.
struct Fingerprint {
  SampleSketch probe, poses;  // of a recording: its counts, 32 rows a window, and its poses, 8
  SampleSketch points;        // of a path: its positions, 8 rows a window
};

Fingerprint fingerprint_of(const Recording& recording);
SampleSketch sketch_poses(const TrackerStream& tracker);
SampleSketch sketch_points(std::span<const Eigen::Vector3d> points);
SampleSketch sketch_values(std::span<const double> values);  // 32 a window

// The share of the smaller table's windows that are in the other one as well, 0 to 1: exact where both sketches are
// whole, otherwise estimated from the hashes below which both are known. 0 if one of them has none.
double shared_share(const SampleSketch& a, const SampleSketch& b);

// The largest of the shares of their probes, poses and points.
double shared_share(const Fingerprint& a, const Fingerprint& b);

// Whether two recordings or paths are one measurement: more than 5 % of their samples are the same. Less is what two
// cuts of one recording share where they meet.
bool is_same_measurement(const Fingerprint& a, const Fingerprint& b);

struct NamedFingerprint {
  std::string name;
  Fingerprint of;
};

// Throws Error naming both if two of them are one measurement.
void check_independent(std::span<const NamedFingerprint> scans);

// {"probe": {"windows": n, "smallest": "…"}, …}: the 32 smallest hashes of each, 16 hexadecimal digits each. What is
// not of that form reads as empty. An overlap of a fifth of either is missed once in a thousand.
Json fingerprint_json(const Fingerprint& fingerprint);
Fingerprint parse_fingerprint(const Json& json);

}  // namespace asperity
