#include <gmock/gmock.h>

#include <string>
#include <string_view>

#include "asperity/base/config.h"
#include "asperity/pipeline/process_methods.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/profile/make_profile.h"
#include "asperity/simulation/simulate_recording.h"

// What it takes to add an estimator: a method with its settings in a file of its own, and a line in the table. This one
// filters and smooths once.
namespace asperity {
namespace {

struct OnePassConfig {
  double gate_chi2 = 16.8;

  template <class V>
  void visit(V& v) {
    v.field("gate_chi2", gate_chi2, "a pose farther off (squared, 3 degrees of freedom) loses weight", {3, 1e6});
  }
};

struct OnePassMethod {
  static constexpr std::string_view kMethodName = "one_pass";
  static constexpr std::string_view kMethodTitle = "an example";

  OnePassConfig one_pass;

  template <class V>
  void visit_method(V& v) {
    v.group("one_pass", one_pass);
  }
  static ProcessMethod make_method() {
    ProcessMethod out = FusedMethod::make_method();  // its other steps serve
    out.estimate_trajectory = [](const Recording& recording, const ProcessConfig&, const Observer& observer) {
      FusedConfig config;
      config.passes = 1;
      return estimate_trajectory_fused(recording, config, observer);
    };
    return out;
  }
};

using WithOwn = MethodTable<FusedMethod, ThesisMethod, OnePassMethod>;

struct OwnConfig : WithOwn {
  Method method = WithOwn::method<OnePassMethod>();

  template <class V>
  void visit(V& v) {
    v.choice("method", method, WithOwn::kNames, "which");
    visit_methods(v);
  }
};

TEST(OwnMethod, IsALineOfTheTable) {
  OwnConfig config;
  const auto fields = list_fields("", config);
  EXPECT_EQ(find_field(fields, "method").get(), ConfigValue("one_pass"));
  set_field(fields, "one_pass.gate_chi2", "20");
  EXPECT_EQ(config.one_pass.gate_chi2, 20.0);
  set_field(fields, "method", "thesis");
  EXPECT_EQ(config.method, WithOwn::method<ThesisMethod>());
  EXPECT_EQ(ProcessMethods::describe(),
            "fused (ours), thesis (the baseline), thesis_tuned (the baseline, tuned), raw (the tracker's poses alone), "
            "ekf (one pass, causal) or particle (many filters, causal)");
  EXPECT_EQ(WithOwn::describe(), "fused (ours), thesis (the baseline) or one_pass (an example)");
}

TEST(OwnMethod, RunsThroughAllStages) {
  SimulationConfig simulation = make_simulation_config("sine", "open");
  simulation.hand.length_m = 0.02;
  const Recording recording = simulate_recording(simulation);
  const ProcessResult own =
      process_recording(recording, {}, WithOwn::get(WithOwn::method<OnePassMethod>()), Observer{});
  ProcessConfig config;
  config.fused.passes = 1;
  const ProcessResult expected = process_recording(recording, config);
  EXPECT_EQ(format_trajectory_csv(own.trajectory.motion), format_trajectory_csv(expected.trajectory.motion));
  EXPECT_EQ(format_profile_csv(own.profile), format_profile_csv(expected.profile));
  EXPECT_TRUE(own.texture.has_value());
}

}  // namespace
}  // namespace asperity
