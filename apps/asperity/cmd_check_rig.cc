#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/geometry/write_stl.h"
#include "asperity/recording/cut_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/rig/check_rig.h"
#include "asperity/session/our_file.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

bool begins_as_rig_check(std::string_view begin) {
  return begin.find("\"asperity-rig-check\"") != std::string_view::npos;
}

class CheckRigCommand : public Command {
 public:
  explicit CheckRigCommand(Parser& root)
      : Command(root, "check-rig", "Check by strokes over a known grating that the scanner measures correctly") {
    parser().add_option("REC", recordings_, "Recordings of strokes over the grating; each segment is one stroke");
    parser().add_option("--pitch", pitch_, "Period of the grating, as measured; 2mm unless given")->type_name("LENGTH");
    parser().add_option("--depth", depth_, "From valley to peak, as measured; 0.2mm unless given")->type_name("LENGTH");
    parser().add_flag("--artefact", artefact_, "Write the grating itself, in mm, to print it");
    parser()
        .add_option("-o,--output", output_, "File of the report, or with --artefact of the grating")
        ->type_name("FILE");
  }

  std::vector<ConfigField> fields() override { return list_fields("", config_); }

  void apply_options() override {
    const auto put = [&](const std::string& option, const std::string& text, const std::string& field) {
      if (text.empty()) return;
      const double length_m = length_option_m("--" + option, text);
      try {
        set_field(fields(), "grating." + field, number_text(length_m));
      } catch (const Error& error) {
        throw UsageError("--" + option + ": " + error.what());
      }
    };
    put("pitch", pitch_, "pitch_m");
    put("depth", depth_, "depth_m");
  }

  int run(const Observer& observer) override {
    if (artefact_) return write_artefact();
    if (recordings_.empty()) throw UsageError("REC: no recording is given");
    if (!output_.empty()) refuse_stranger(output_, begins_as_rig_check, recordings_);
    std::vector<NamedRecording> strokes;
    for (const std::string& path : recordings_) add_strokes(path, strokes, observer);
    const RigCheck check = check_rig(strokes, config_, observer);
    const std::string json = rig_check_json(check, config_);
    if (!output_.empty()) write_file(output_, json + "\n");
    print_json(json);
    say(rig_check_text(check, config_));
    for (const Verdict& verdict : check.verdicts) {
      if (verdict.severity != Severity::kNote) print_error(verdict_line(verdict));
    }
    return check.right ? kDone : kNotTrustworthy;
  }

 private:
  static void add_strokes(const std::string& path, std::vector<NamedRecording>& strokes, const Observer& observer) {
    constexpr std::size_t kMost = 1000;
    Recording recording = read_recording(path, {}, observer);
    const std::vector<Segment> pieces = separate_segments(recording);
    const std::string name = printable(path, 200);
    if (pieces.size() + strokes.size() >= kMost) throw Error(name + ": has more than 1000 strokes");
    if (pieces.empty()) {
      strokes.push_back({name, std::move(recording)});
      return;
    }
    const std::vector<std::string> names = segment_folders(pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      strokes.push_back({name + ":" + names[i], cut_recording(recording, pieces[i].start_ns, pieces[i].end_ns)});
    }
  }

  int write_artefact() {
    if (!recordings_.empty()) throw UsageError("--artefact needs no recording; leave REC out");
    if (output_.empty()) throw UsageError("--artefact: -o FILE.stl is required");
    std::error_code ignored;
    if (fs::exists(output_, ignored)) throw Error(printable(output_, 200) + ": exists; nothing was changed");
    const TriangleMesh grating = make_sine_grating(config_.grating);
    MeshFile file;
    constexpr double kMillimetres = 1e3;
    for (const Eigen::Vector3d& p_m : grating.vertices_m) file.vertices.push_back(kMillimetres * p_m);
    file.triangles = grating.triangles;
    write_stl(output_, file);
    print_json("{\"format\":\"asperity-rig-artefact\",\"version\":1,\"triangles\":" +
               std::to_string(file.triangles.size()) + "}");
    say(printable(output_, 200) + ": " + std::to_string(file.triangles.size()) + " triangles, in mm\n");
    return kDone;
  }

  std::vector<std::string> recordings_;
  std::string pitch_, depth_, output_;
  bool artefact_ = false;
  CheckRigConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_check_rig(Parser& root) { return std::make_unique<CheckRigCommand>(root); }

}  // namespace asperity::app
