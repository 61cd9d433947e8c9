#pragma once

#include <cstdint>

#include "asperity/link/probe_faults.h"

namespace asperity {

// What a probe's link has carried so far. All counts only rise, except those of `faults`.
struct LinkStatistics {
  std::uint64_t bytes = 0;
  std::uint64_t frames = 0;         // of samples, accepted
  std::uint64_t samples = 0;        // accepted rows of the inertial sensor
  std::uint64_t force_samples = 0;  // accepted samples of the force sensor
  std::uint64_t lost_frames =
      0;  // never arrived whole, or late: exact where frames are numbered, else estimated from time
  std::uint64_t lost_samples = 0;    // rows in those, and those that the probe dropped and numbered
  std::uint64_t damaged_frames = 0;  // pieces between delimiters that failed their check, or bytes given up as frames
  std::uint64_t late_frames = 0;     // came twice or after a later one; not used
  std::uint64_t foreign_frames = 0;  // sound, but of a type or version that is not known
  std::uint64_t resyncs = 0;         // times that the frames had to be found again
  std::uint64_t restarts = 0;        // times that the probe restarted its count
  std::uint64_t overruns = 0;        // times that the probe said that it had dropped samples itself
  bool losses_are_estimated = false;
  ProbeFaults faults;  // as last stated by the probe
};

// Of both, one after the other.
inline LinkStatistics& operator+=(LinkStatistics& a, const LinkStatistics& b) {
  a.bytes += b.bytes;
  a.frames += b.frames;
  a.samples += b.samples;
  a.force_samples += b.force_samples;
  a.lost_frames += b.lost_frames;
  a.lost_samples += b.lost_samples;
  a.damaged_frames += b.damaged_frames;
  a.late_frames += b.late_frames;
  a.foreign_frames += b.foreign_frames;
  a.resyncs += b.resyncs;
  a.restarts += b.restarts;
  a.overruns += b.overruns;
  a.losses_are_estimated = a.losses_are_estimated || b.losses_are_estimated;
  if (b.faults.any()) a.faults = b.faults;
  return a;
}
inline LinkStatistics operator+(LinkStatistics a, const LinkStatistics& b) { return a += b; }

}  // namespace asperity
