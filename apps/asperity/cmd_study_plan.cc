#include <fmt/format.h>

#include <memory>
#include <string>

#include "asperity/json/json.h"
#include "asperity/study/plan_power.h"
#include "commands.h"

namespace asperity::app {

namespace {

class StudyPlanCommand : public Command {
 public:
  explicit StudyPlanCommand(Parser& study)
      : Command(study, "plan", "The number of trials that a study by pairs needs to find an expected difference") {
    parser()
        .add_option("--share", config_.share,
                    "Expected share of the trials in which one texture is chosen, 0.5 by chance; default: 0.75")
        ->type_name("SHARE");
    parser()
        .add_option("--alpha", config_.alpha, "Largest probability of a false difference; default: 0.05")
        ->type_name("ALPHA");
    parser()
        .add_option("--power", config_.power, "Least probability of finding the difference; default: 0.8")
        ->type_name("POWER");
    parser()
        .add_option("--trials", trials_, "Give the power of this number of trials instead")
        ->in_range(1, kMostPlannedTrials)
        ->type_name("N");
  }

  int run(const Observer&) override {
    const bool is_given = parser().count("--trials") > 0;
    const int trials = is_given ? trials_ : trials_for_power(config_);
    const double power = power_of_trials(trials, config_.share, config_.alpha);
    Json out = Json::object();
    out["trials"] = trials;
    out["power"] = power;
    out["share"] = config_.share;
    out["alpha"] = config_.alpha;
    print_json(out.dump_repaired(2));
    say(fmt::format("trials      {} of the pair, in all repetitions and by all participants\n", trials));
    say(fmt::format("power       {:.1f} % to find a share of {:g} % against chance\n", 100.0 * power,
                    100.0 * config_.share));
    say(fmt::format("test        exact binomial, two-sided, alpha {:g}\n", config_.alpha));
    say(fmt::format("repetitions {} (two trials of a pair each), by one participant\n", (trials + 1) / 2));
    say("            answers of one participant are alike: for several, use more, or a mixed model\n");
    return kDone;
  }

 private:
  PowerConfig config_;
  int trials_ = 0;
};

}  // namespace

std::unique_ptr<Command> make_study_plan(Parser& study) { return std::make_unique<StudyPlanCommand>(study); }

}  // namespace asperity::app
