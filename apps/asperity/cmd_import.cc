#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/recording/import_imu_pose.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/write_recording.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

class ImportCommand : public Command {
 public:
  explicit ImportCommand(Parser& root)
      : Command(root, "import", "Make a recording of an inertial sensor's and a motion capture's files") {
    require(parser().add_option("--imu", imu_, "t_s,ax_mps2,ay_mps2,az_mps2,gx_radps,gy_radps,gz_radps"))
        ->type_name("FILE.csv");
    require(parser().add_option("--pose", pose_, "t_s,px_m,py_m,pz_m,qw,qx,qy,qz"))->type_name("FILE.csv");
    parser()
        .add_option("--object-pose", object_pose_, "The same of the object, where it moves: the scan is relative to it")
        ->type_name("FILE.csv");
    parser().add_option("--pose-rate", rate_, "Thin the poses to this rate, Hz")->type_name("HZ");
    parser().add_option("--pose-noise", noise_, "Add noise along the world's axes")->type_name("X,Y,Z");
    parser().add_option("--seed", seed_, "Of the noise")->type_name("N");
    require(parser().add_option("-o,--output", output_, "The recording's folder"))->type_name("REC");
  }

  std::vector<ConfigField> fields() override { return list_fields("import", config_); }

  void apply_options() override {
    if (!noise_.empty()) config_.pose_noise_m = lengths_option_m("--pose-noise", noise_);
    try {
      if (!rate_.empty()) set_field(fields(), "import.pose_rate_Hz", rate_);
      if (!seed_.empty()) set_field(fields(), "import.seed", seed_);
    } catch (const Error& error) {
      throw UsageError(error.what());
    }
  }

  int run(const Observer& observer) override {
    OutputFolder folder(output_, is_replaceable_recording);
    const ImportInput input = read_imu_pose(imu_, pose_, object_pose_);
    observer.update("importing", 0.5);
    const Recording recording = import_imu_pose(input, config_);
    write_recording(folder.path(), recording);
    observer.update("importing", 1.0);
    commit_output(folder, output_);
    report(recording, input.problems);
    return kDone;
  }

 private:
  void report(const Recording& recording, const Problems& problems) {
    Json out;
    out["format"] = "asperity-imported";
    out["version"] = 1;
    out["recording"] = output_;
    out["probe_rows"] = recording.probe.size();
    out["tracker_rows"] = recording.tracker.size();
    if (!recording.body_poses.empty()) out["object_rows"] = recording.body_poses.front().size();
    out["problems"] = Json::array();
    std::string text = fmt::format("{}: {} probe rows, {} poses\n", printable(output_, 200), recording.probe.size(),
                                   recording.tracker.size());
    if (!recording.body_poses.empty())
      text += fmt::format("{} poses of the object\n", recording.body_poses.front().size());
    for (const Problem& problem : problems) {
      out["problems"].push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
      text += problem.message + "\n";
    }
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    say(text);
  }

  std::string imu_;
  std::string pose_;
  std::string object_pose_;
  std::string rate_;
  std::string noise_;
  std::string seed_;
  std::string output_;
  ImportConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_import(Parser& root) { return std::make_unique<ImportCommand>(root); }

}  // namespace asperity::app
