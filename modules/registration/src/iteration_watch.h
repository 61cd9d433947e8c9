#pragma once

#include "asperity/registration/registration_iteration.h"
#include "match_points.h"

namespace asperity::registration {

// An observer of the iterations, and which phase and start they belong to.
class IterationWatch {
 public:
  explicit IterationWatch(const RegistrationObserver& observer) : observer_(observer) {}

  void begin(RegistrationPhase phase) {
    phase_ = phase;
    start_ = -1;
  }
  void next_start() { ++start_; }

  // Throws Cancelled if the user has asked to stop.
  void check() const {
    if (observer_.cancelled && observer_.cancelled()) throw Cancelled();
  }
  bool wants_iterations() const { return static_cast<bool>(observer_.iterated); }

  // Reports the matcher's present pairs; those within `width_m` are inliers.
  void report(const Matcher& matcher, const PointSet& points, const CentredPose& pose, double width_m) const;
  void report(const Pose& T_mesh_world, double rms_m, std::size_t points, std::size_t inliers) const;

 private:
  const RegistrationObserver& observer_;
  RegistrationPhase phase_ = RegistrationPhase::kAnnealing;
  int start_ = -1;
};

}  // namespace asperity::registration
