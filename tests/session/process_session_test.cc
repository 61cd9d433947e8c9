#include "asperity/pipeline/process_session.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "asperity/base/random.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/simulation/simulate_recording.h"
#include "asperity/texture/texture_file.h"

// The oracle is process_recording() itself, which keeps nothing: not a bit may differ.
namespace asperity {
namespace {

const Recording& short_scan() {
  static const Recording recording = [] {
    SimulationConfig config = make_simulation_config("sandpaper", "what");
    config.hand.length_m = 0.02;
    return simulate_recording(config);
  }();
  return recording;
}

// All that is in a result, as text.
std::string everything(const ProcessResult& result, const Recording& recording) {
  std::string out = format_result(result, recording, "scan");
  out += format_trajectory_csv(result.trajectory.motion);
  out += format_profile_csv(result.profile);
  for (const ComplianceWindow& window : result.compliance.windows)
    out += number_text(window.force_N) + " " + number_text(window.ratio) + "\n";
  for (const char contact : result.base.contact) out += contact != 0 ? '1' : '0';
  for (const Eigen::Vector3d& n : result.base.path.n_world) out += number_text(n.x()) + number_text(n.z());
  if (result.texture) out += format_texture(*result.texture);
  return out;
}

// The result, or the error where there is none.
template <class Process>
std::string outcome(const Recording& recording, Process process) {
  try {
    return everything(process(), recording);
  } catch (const Error& error) {
    return std::string("error: ") + error.what();
  }
}

std::string fresh(const Recording& recording, const ProcessConfig& config) {
  return outcome(recording, [&] { return process_recording(recording, config); });
}

std::string kept(ProcessSession& session, const ProcessConfig& config) {
  return outcome(session.recording(), [&]() -> const ProcessResult& { return session.process(config); });
}

// Gives a field another value that it takes; the factor is for numbers.
void change(const ConfigField& field, double factor) {
  const ConfigValue before = field.get();
  std::vector<ConfigValue> candidates{true, false};
  for (const std::string& choice : field.choices) candidates.push_back(choice);
  if (field.type == FieldType::kInteger || field.type == FieldType::kNumber) {
    const double value = std::stod(toml_text(before));
    for (const double other : {value * factor, value / factor, value + 1.0, value - 1.0, value + 0.01}) {
      if (field.type == FieldType::kInteger) {
        candidates.push_back(static_cast<std::int64_t>(other));
      } else {
        candidates.push_back(other);
      }
    }
  }
  for (const ConfigValue& candidate : candidates) {
    try {
      field.set(candidate);
    } catch (const Error&) {
      continue;
    }
    if (field.get() != before) return;
  }
  FAIL() << field.path << " = " << toml_text(before) << " could not be changed";
}

TEST(ProcessSession, EveryFieldChangedAloneGivesWhatAFreshRunGives) {
  const Recording& recording = short_scan();
  ProcessSession session(recording);
  for (const Method method : {ProcessMethods::method<FusedMethod>(), ProcessMethods::method<ThesisMethod>()}) {
    ProcessConfig config;
    config.method = method;
    const std::string before = fresh(recording, config);
    const std::vector<ConfigField> fields = list_fields("", config);
    ASSERT_GT(fields.size(), 60U);
    for (const ConfigField& field : fields) {
      const ConfigValue value = field.get();
      change(field, 1.25);
      EXPECT_TRUE(kept(session, config) == fresh(recording, config)) << field.path << " from " << toml_text(value);
      field.set(value);
      EXPECT_TRUE(kept(session, config) == before) << field.path << " back at " << toml_text(value);
    }
  }
}

TEST(ProcessSession, AnyOrderOfChangesGivesWhatAFreshRunGives) {
  const Recording& recording = short_scan();
  ProcessSession session(recording);
  Random random(7);
  ProcessConfig config;
  for (int step = 0; step < 60; ++step) {
    if (random.uniform() < 0.15) config = {};
    std::vector<ConfigField> fields = list_fields("", config);
    // The few that shape the rest come more often than their number.
    std::erase_if(fields, [&](const ConfigField& field) {
      return random.uniform() < 0.7 && (field.path.starts_with("fused.") || field.path.starts_with("thesis.tra"));
    });
    const auto which = static_cast<std::size_t>(random.uniform() * static_cast<double>(fields.size()));
    change(fields.at(which), random.uniform(0.3, 3.0));
    ASSERT_TRUE(kept(session, config) == fresh(recording, config)) << "step " << step << ": " << fields[which].path;
  }
}

TEST(ProcessSession, WhatFailsInBetweenLeavesNothingBehind) {
  Recording recording = short_scan();
  recording.truth.reset();
  ProcessSession session(recording);
  std::vector<ProcessConfig> bad(6);
  bad[0].base.shape = PathShape::kMesh;     // no base path
  bad[1].profile.spacing_m = 9e-3;          // no roughness
  bad[2].base.contact.touch_N = 900.0;      // nothing in contact
  bad[3].base.contact.release_N = 1.0;      // refused
  bad[4].periodicity.min_pitch_m = 0.5;     // refused in the middle of the stages
  bad[5].fused.tracker_time_sigma_s = 0.5;  // a trajectory that is another
  bad.push_back({});
  std::vector<std::string> expected;
  for (const ProcessConfig& config : bad) expected.push_back(fresh(recording, config));
  for (std::size_t one = 0; one < bad.size(); ++one) {
    for (std::size_t other = 0; other < bad.size(); ++other) {
      EXPECT_TRUE(kept(session, bad[one]) == expected[one]) << one << " before " << other;
      EXPECT_TRUE(kept(session, bad[other]) == expected[other]) << other << " after " << one;
    }
  }
}

TEST(ProcessSession, GoesOnAfterACancel) {
  const Recording& recording = short_scan();
  ProcessSession session(recording);
  ProcessConfig config;
  session.process(config);
  config.fused.gate_chi2 = 20.0;
  config.profile.cutoff_cycles_per_mm = 0.2;
  // Asked to stop at each of its questions in turn, until it is through.
  int refused = 0;
  for (int allowed = 0;; ++allowed) {
    int asked = 0;
    Observer observer;
    observer.cancelled = [&] { return asked++ >= allowed; };
    try {
      session.process(config, observer);
      break;
    } catch (const Cancelled&) {
      ++refused;
    }
    ASSERT_LT(allowed, 1000);
  }
  EXPECT_GT(refused, 5);
  EXPECT_TRUE(kept(session, config) == fresh(recording, config));
}

TEST(ProcessSession, RunsOnlyWhatAChangeTouches) {
  ProcessSession session(short_scan());
  ProcessConfig config;
  const auto runs_the_trajectory = [&] {
    bool ran = false;
    Observer observer;
    observer.progress = [&](std::string_view stage, double) { ran |= stage == "filter" || stage == "smoother"; };
    session.process(config, observer);
    return ran;
  };
  EXPECT_TRUE(runs_the_trajectory());
  EXPECT_FALSE(runs_the_trajectory());
  config.profile.cutoff_cycles_per_mm = 0.3;
  config.base.contact.touch_N = 0.2;
  config.thesis.profile.order = 3;
  EXPECT_FALSE(runs_the_trajectory());
  config.fused.passes = 2;
  EXPECT_TRUE(runs_the_trajectory());
}

TEST(ProcessSession, ARecordingWithoutForce) {
  Recording recording = short_scan();
  std::fill(recording.probe.force_counts.begin(), recording.probe.force_counts.end(), 100.0);
  ProcessSession session(recording);
  ProcessConfig config;
  for (const double cutoff : {0.1, 0.4, 0.1}) {
    config.profile.cutoff_cycles_per_mm = cutoff;
    EXPECT_TRUE(kept(session, config) == fresh(recording, config));
  }
}

}  // namespace
}  // namespace asperity
