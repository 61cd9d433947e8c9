#pragma once

#include <optional>
#include <string>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/pipeline/force_limit.h"
#include "asperity/pipeline/measure_accuracy.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/profile/erode_profile.h"
#include "asperity/profile/estimate_compliance.h"
#include "asperity/profile/estimate_friction.h"
#include "asperity/profile/estimate_stiffness.h"
#include "asperity/profile/find_base_path.h"
#include "asperity/profile/find_periodicity.h"
#include "asperity/profile/merge_passes.h"
#include "asperity/profile/profile.h"
#include "asperity/profile/roughness.h"
#include "asperity/profile/surface_spectrum.h"
#include "asperity/profile/texture_noise.h"
#include "asperity/texture/fit_fourier1d.h"
#include "asperity/texture/texture.h"
#include "asperity/trajectory/trajectory_result.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

// Speed along the base path over the profile's points.
struct SpeedStatistics {
  double mean_mps = 0.0;
  double lowest_mps = 0.0;
  double highest_mps = 0.0;
};

// The part of a profile that has heights.
struct Coverage {
  double length_m = 0.0;  // from the first to the last height, or the path's ends beside them
  double covered = 0.0;   // part of it that is not gap
  std::size_t gaps = 0;
};

// A line that paths are over more than once (docs/merge.md).
struct RepeatedLine {
  struct Span {
    std::size_t scan = 0;  // of `register`; 0 of `process`
    double from_m = 0.0;   // of the scan's arc length
    double to_m = 0.0;
  };
  std::vector<Span> spans;  // of each pass
  MergedProfile merged;     // its passes and their differences; without its profile
  bool laid = false;        // the merge is in the place of the passes' heights
  bool one_line = false;    // they differ as noise does, not as lines beside one another: a witness of their noise
  std::string reason;       // why not
};

// Everything measured in one recording. What the data did not allow is absent, and a Problem says why.
struct ProcessResult {
  TrajectoryResult trajectory;
  BasePathResult base;
  Profile profile;
  Coverage coverage;
  SpeedStatistics speed;
  TextureNoise noise;                        // of profile.texture_m
  std::optional<RoughnessResult> roughness;  // of profile.texture_m
  std::optional<MergedProfile> passes;       // of merge_results.h; its profile is empty, for it is the one above
  std::vector<RepeatedLine> lines;           // that the path is over more than once
  Profile measured_profile;                  // before the expected noise was removed, and its noise
  TextureNoise measured_noise;
  std::optional<ErodedProfile> surface;  // under profile.height_m, if it was asked for
  Periodicity periodicity;               // of profile.height_m
  SurfaceSpectrum spectrum;              // of the texture, its noise taken off
  Compliance compliance;
  StiffnessEstimate stiffness;
  FrictionEstimate friction;
  ForceLimit force_limit;
  std::optional<FourierFit> fit;
  std::optional<Texture> texture;
  std::optional<Accuracy> accuracy;  // where the recording knows the truth
  Problems problems;                 // of all stages, the reading of the recording included
  Verdicts verdicts;                 // the worst first; docs/verdicts.md
  bool trustworthy = true;           // none of them is invalid
  std::string verdict;               // they in a sentence; empty if none is invalid or limited
  ProcessConfig config;              // the settings that gave it
};

}  // namespace asperity
