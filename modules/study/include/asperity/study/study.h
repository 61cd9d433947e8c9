#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/render/texture_force_model.h"
#include "asperity/study/staircase.h"

namespace asperity {

enum class StudyMethod { kPairs, kStaircase, kRating };
inline constexpr std::array<std::string_view, 3> kStudyMethodNames{"pairs", "staircase", "rating"};

// What of a texture the level of a staircase changes (docs/studio-study.md).
enum class StudyParameter { kHeight, kHeightDifference, kStiffnessDifference, kFrictionDifference };
inline constexpr std::array<std::string_view, 4> kStudyParameterNames{"height", "height-difference",
                                                                      "stiffness-difference", "friction-difference"};

inline constexpr int kLowestRating = 1, kHighestRating = 7;

// How textures are presented.
struct StudyPresentation {
  std::string device = "mouse";  // by its name, as of `asperity feel`
  double tile_mm = 30.0;
  double gap_mm = 4.0;
  double range_mm = 2.5;
  double stiffness_N_per_m = 1000.0;
  double friction = 0.0;
  double least_force_N = 0.1;
  double least_touch_s = 0.2;
  TextureForceModel model = TextureForceModel::kAuto;

  template <class V>
  void visit(V& v) {
    v.field("tile_mm", tile_mm, "side of a tile, mm", {1.0, 1000.0});
    v.field("gap_mm", gap_mm, "of bare plane between tiles and round them, mm", {0.0, 100.0});
    v.field("range_mm", range_mm, "black to white, of images, mm", {1e-6, 1000.0});
    v.field("stiffness_N_per_m", stiffness_N_per_m, "where a texture has none, N/m", {1.0, 1e6});
    v.field("friction", friction, "coefficient, where a texture has none", {0.0, 10.0});
    v.field("least_force_N", least_force_N, "force on the hand that counts as touching, N", {0.0, 10.0});
    v.field("least_touch_s", least_touch_s, "of touching each texture before an answer is accepted, s", {0.0, 60.0});
    v.choice("model", model, kTextureForceModelNames, "force model; auto: the texture's own");
  }
};

// What is asked of a participant, and how: the content of a *.study.json.
struct Study {
  std::string name = "study";
  StudyMethod method = StudyMethod::kPairs;
  std::string question = "Which one is rougher?";
  std::vector<std::string> stimuli;  // names in the project's folder
  std::string object;                // the real one that ratings compare with
  std::string consent;               // what participants agree to before the first trial; empty: they are not asked
  int repetitions = 1;
  std::int64_t seed = 1;
  int break_every = 20;  // trials; 0: never
  bool dates = false;
  StudyParameter parameter = StudyParameter::kHeightDifference;
  StaircaseConfig staircase;
  StudyPresentation presentation;

  // All but texts and lists.
  template <class V>
  void visit(V& v) {
    v.choice("method", method, kStudyMethodNames, "of asking");
    v.field("repetitions", repetitions, "of all trials, or tracks of each texture", {1, 100});
    v.field("seed", seed, "of the order", {0, 1LL << 53});
    v.field("break_every", break_every, "trials; 0: no breaks", {0, 1000});
    v.field("dates", dates, "whether rows of the log have a date and time");
    v.choice("staircase.parameter", parameter, kStudyParameterNames, "that the level changes");
    v.group("staircase", staircase);
    v.group("presentation", presentation);
  }
};

}  // namespace asperity
