#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "asperity/json/json.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/profile/align_passes.h"
#include "asperity/profile/profile_pass.h"
#include "asperity/recording/fingerprint.h"

namespace asperity {

struct MergeConfig {
  AlignPassesConfig align;
  ProcessConfig process;

  template <class V>
  void visit(V& v) {
    v.group("align", align);
    v.group("process", process);
  }
};

// A stroke with what it was measured from; its name is the pass'.
struct MergeStroke {
  ProfilePass pass;
  Fingerprint fingerprint;  // empty: not known
  std::string invalid;      // why its own result is invalid, its noise left out, which a merge lowers; empty: it is not
};

// A result's profile with its noise, as a pass.
ProfilePass pass_of_result(const ProcessResult& result, const std::string& name);

// A recording's profile as a stroke: of process_recording() with `profile.remove_noise` off.
MergeStroke stroke_of_result(const ProcessResult& result, const Recording& recording, const std::string& name);

// The same of a folder that `process` has written: profile.csv, the noise of spectrum.csv and result.json. Throws Error
// naming the file if one is missing or damaged, or if the noise was removed from the heights: what is left of it then
// is not the same in each stroke. A result that is invalid, or states no verdict, is a stroke that is `invalid`.
MergeStroke read_stroke(const std::filesystem::path& folder, const std::string& name);

// Strokes over one line as one (merge_passes.h): `passes` say where each is, and profile, noise, roughness, pattern,
// spectrum and texture are those of their mean, its noise removed if `process.profile.remove_noise` is on. Verdicts:
// invalid if no two agree, if two differ by so little that they are no two measurements, if a stroke of it is, or if
// its noise is not known; limited if some were left out, if they differ by more than they state, or share too little
// for that to be determined. Throws Error as merge_passes() and check_independent() do.
ProcessResult merge_results(std::span<const MergeStroke> strokes, const std::string& object, const MergeConfig& config);

// result.json of a merge, and all of its files: profile.csv, spectrum.csv, texture.json if there is one, result.json.
Json merge_json(const ProcessResult& result, const MergeConfig& config, const std::string& object);
void write_merge(const std::filesystem::path& folder, const ProcessResult& result, const MergeConfig& config,
                 const std::string& object);

}  // namespace asperity
