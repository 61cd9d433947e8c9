#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/problem.h"

namespace asperity {

// What a stage has to say beside its part of the result.
struct StageNotes {
  Problems problems;
  std::vector<std::string> doubts;  // why the result is not to be trusted
  bool failed = false;              // its part is empty, and what needs it cannot be had
};

enum class Stage {
  kTrajectory,
  kBasePath,
  kProfile,
  kRoughness,
  kPeriodicity,
  kCompliance,
  kStiffness,
  kTexture,
  kAccuracy,
};
inline constexpr std::size_t kStages = 9;

// Which parts of a result still hold: those of the stages whose settings and inputs are the ones of their last run.
class KeptStages {
 public:
  // The notes of the stage's last run; first runs `work`, which gives them, if the stage does not hold: if `settings`
  // differ, or one of `inputs` has run since. What `work` throws goes on, and the stage does not hold then.
  template <class Work>
  const StageNotes& run(Stage stage, std::initializer_list<Stage> inputs, std::string settings, Work work) {
    for (const Stage input : inputs) settings += "\n" + std::to_string(at(input).runs);
    Kept& kept = at(stage);
    if (kept.key == settings) return kept.notes;
    kept.key.reset();
    ++kept.runs;
    kept.notes = work();
    kept.key = std::move(settings);
    return kept.notes;
  }

  void drop(Stage stage) { at(stage).key.reset(); }

 private:
  struct Kept {
    std::optional<std::string> key;
    std::size_t runs = 0;
    StageNotes notes;
  };
  Kept& at(Stage stage) { return stages_.at(static_cast<std::size_t>(stage)); }

  std::array<Kept, kStages> stages_;
};

}  // namespace asperity
