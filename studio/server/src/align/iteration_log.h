#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "asperity/registration/registration_iteration.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// The iterations of one registration, from the thread that registers to the browsers. Thread-safe.
class IterationLog {
 public:
  // Beyond these only the count continues; a registration has a few thousand.
  static constexpr std::size_t kMost = 50'000;

  explicit IterationLog(std::uint64_t run) : run_(run) {}

  void add(const RegistrationIteration& iteration);

  // What has come since the last time, as a block of kind "align.iteration": head "run", "first" (how many went
  // before), "sequence" (of the blocks), "phases" (names); arrays "T_mesh_world" [n, 7] as in json_pose.h, "rms_m",
  // "phase", "start", "points", "inliers". nullopt: nothing.
  std::optional<BlockWriter> take_news();
  // All so far, the same way.
  BlockWriter all() const;

 private:
  BlockWriter block(std::size_t from, std::size_t to) const;

  mutable std::mutex mutex_;
  std::uint64_t run_;
  std::uint64_t sequence_ = 0;
  std::size_t sent_ = 0;
  std::vector<RegistrationIteration> iterations_;
};

}  // namespace asperity::studio
