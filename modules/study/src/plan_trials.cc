#include "asperity/study/plan_trials.h"

#include <utility>

#include "asperity/base/random.h"
#include "asperity/study/study_error.h"

namespace asperity {

namespace {

constexpr std::size_t kSidesTogether = 4;

std::size_t below(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
}

// Fisher and Yates.
template <class List>
void shuffle_list(List& list, Random& random) {
  for (std::size_t k = list.size(); k > 1; --k) {
    const std::size_t other = below(random, k);
    const typename List::value_type kept = list[k - 1];
    list[k - 1] = list[other];
    list[other] = kept;
  }
}

Random random_of(const Study& study, std::string_view participant, int run, const std::string& purpose) {
  return Random(static_cast<std::uint64_t>(study.seed), study_stream(participant, run, purpose));
}

std::size_t trials_of(const Study& study) {
  const std::size_t n = study.stimuli.size();
  const auto repetitions = static_cast<std::size_t>(study.repetitions);
  if (study.method == StudyMethod::kPairs) return repetitions * n * (n - 1);
  if (study.method == StudyMethod::kRating) return repetitions * n;
  return repetitions * n * static_cast<std::size_t>(study.staircase.most_trials);
}

}  // namespace

void check_plan(const Study& study) {
  const std::size_t least = study.method == StudyMethod::kPairs ? 2 : 1;
  if (study.stimuli.size() < least) {
    throw StudyError(StudyFault::kTooFewTextures,
                     least == 2 ? "pairs need two textures at least" : "the study has no textures");
  }
  const std::size_t trials = trials_of(study);
  if (trials > kMostTrials) {
    throw StudyError(StudyFault::kTooManyTrials, "the study may take " + std::to_string(trials) +
                                                     " trials, more than " + std::to_string(kMostTrials));
  }
  if (study.method == StudyMethod::kStaircase) check_staircase(study.staircase);
}

std::uint64_t study_stream(std::string_view participant, int run, std::string_view purpose) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  const std::string text = std::string(participant) + '\n' + std::to_string(run) + '\n' + std::string(purpose);
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  return hash;
}

std::vector<Trial> plan_trials(const Study& study, std::string_view participant, int run) {
  const int n = static_cast<int>(study.stimuli.size());
  std::vector<std::pair<int, int>> once;
  for (int i = 0; i < n; ++i) {
    if (study.method == StudyMethod::kRating) once.emplace_back(i, -1);
    if (study.method != StudyMethod::kPairs) continue;
    for (int j = 0; j < n; ++j) {
      if (i != j) once.emplace_back(i, j);
    }
  }
  Random random = random_of(study, participant, run, "order");
  std::vector<Trial> out;
  for (int repetition = 1; repetition <= study.repetitions; ++repetition) {
    shuffle_list(once, random);
    for (const auto& [left, right] : once) {
      Trial trial;
      trial.number = static_cast<int>(out.size()) + 1;
      trial.repetition = repetition;
      trial.left = left;
      trial.right = right;
      out.push_back(trial);
    }
  }
  return out;
}

std::vector<bool> plan_sides(const Study& study, std::string_view participant, int run, int track) {
  Random random = random_of(study, participant, run, "sides " + std::to_string(track));
  std::vector<bool> out;
  const auto most = static_cast<std::size_t>(study.staircase.most_trials);
  while (out.size() < most) {
    std::vector<bool> some(kSidesTogether);
    for (std::size_t k = 0; k < kSidesTogether; k += 2) some[k] = true;
    shuffle_list(some, random);
    out.insert(out.end(), some.begin(), some.end());
  }
  out.resize(most);
  return out;
}

int choose_track(const Study& study, std::string_view participant, int run, int trial, const std::vector<int>& open) {
  Random random = random_of(study, participant, run, "track " + std::to_string(trial));
  return open.at(below(random, open.size()));
}

}  // namespace asperity
