#pragma once

#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"
#include "asperity/registration/registration_result.h"
#include "asperity/verdict/judge_registration.h"
#include "asperity/verdict/judge_scan.h"

namespace asperity {

// The evidence for and against a result (judge_scan.h), from the result and its recording. `result.trajectory` has to
// be there; without a profile, and with no Problem that says why, the stages after it count as not run.
ScanEvidence scan_evidence(const Recording& recording, const ProcessResult& result);

// That of a registration, for judge_registration.h.
PoseEvidence pose_evidence(const RegistrationResult& registration);

// The verdicts on the pose of scans on a mesh. Without a guess their position along a motion that nothing determines is
// arbitrary.
Verdicts judge_pose(const RegistrationResult& registration, bool guessed);

// A force sensor that never changes is none: whether the tip touched is then not known.
bool has_force(const Recording& recording);

}  // namespace asperity
