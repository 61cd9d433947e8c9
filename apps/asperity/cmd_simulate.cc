#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/length_unit_names.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/config_json.h"
#include "asperity/recording/recording_source.h"
#include "asperity/recording/write_recording.h"
#include "asperity/session/live_scan.h"
#include "asperity/simulation/mesh_stroke.h"
#include "asperity/simulation/simulate_recording.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

class SimulateCommand : public Command {
 public:
  explicit SimulateCommand(Parser& root)
      : Command(root, "simulate", "Simulate a recording: a hand scans a surface with a probe in front of a tracker") {
    std::string names;
    std::vector<std::string_view> surfaces;
    for (const auto name : kSurfaceNames) {
      if (name == "file") continue;  // that is, a file's name
      names += std::string(names.empty() ? "" : ", ") + std::string(name);
      surfaces.push_back(name);
    }
    require(parser().add_option("--surface", surface_, names + ", or a file of heights"))
        ->type_name("NAME|FILE")
        ->suggest(surfaces);
    parser()
        .add_option("--spacing", spacing_, "Distance of the heights of a --surface FILE without positions, as a TIFF")
        ->type_name("LENGTH");
    parser()
        .add_option("--probe", probe_,
                    "open (the default: 16 bit, 4 kHz), or what (8 bit, 400 Hz: the probe of the thesis)")
        ->type_name("NAME")
        ->suggest(kProbeModelNames);
    parser()
        .add_option("--material", material_, "Material of the surface: stiff (the default), cork or soft_rubber")
        ->type_name("NAME")
        ->suggest(kContactMaterialNames);
    parser()
        .add_option("--mesh", mesh_, "A mesh to scan over; the surface is laid on it along the path")
        ->type_name("FILE");
    parser()
        .add_option("--mesh-unit", mesh_unit_,
                    "Unit of the mesh file: m (the default of a mesh of 1 mm to 5 m), mm or a length such as 0.06m")
        ->type_name("UNIT")
        ->suggest(length_unit_names());
    parser()
        .add_option("--through", through_,
                    "Points of the path over the mesh, in its own frame, m; default: a path is chosen")
        ->type_name("\"X,Y,Z;X,Y,Z\"");
    parser()
        .add_option(
            "--object-motion", object_motion_,
            "none (the default), held (in the other hand, with a marker body on it) or turned (held and rotated)")
        ->type_name("NAME")
        ->suggest(kSimulatedObjectMotionNames);
    parser().add_option("--speed", speed_, "Mean speed of the hand")->type_name("SPEED");
    parser().add_option("--seed", seed_, "Random seed; the same seed gives the same bytes")->type_name("N");
    parser().add_flag("--live", live_,
                      "Play the scan in real time: the probe over a pseudo-terminal, the camera over a FIFO");
    require(parser().add_option("-o,--output", output_, "The recording's folder"))->type_name("REC");
  }

  std::vector<ConfigField> fields() override {
    if (!config_) {
      try {
        config_ = make_simulation_config(surface_, probe_, material_);
      } catch (const Error& error) {
        throw UsageError(error.what());
      }
    }
    std::vector<ConfigField> all = list_fields("", *config_);
    if (live_) {
      for (ConfigField& field : list_fields("live", live_config_)) all.push_back(std::move(field));
    }
    return all;
  }

  void apply_options() override {
    if (!spacing_.empty()) {
      if (config_->surface.kind != SurfaceKind::kFile)
        throw UsageError("--spacing: needs a file of heights as --surface");
      config_->surface.file_spacing_m = length_option_m("--spacing", spacing_);
    }
    if (mesh_.empty() && !(mesh_unit_.empty() && through_.empty()))
      throw UsageError(std::string(through_.empty() ? "--mesh-unit" : "--through") + " needs --mesh");
    if (!mesh_.empty()) {
      config_->shape.kind = BaseShapeKind::kMesh;
      config_->shape.mesh_file = mesh_;
      if (!mesh_unit_.empty()) config_->shape.mesh_unit_m = unit_option_m("--mesh-unit", mesh_unit_);
      try {
        parse_points_m(through_, "--through");
      } catch (const Error& error) {
        throw UsageError(error.what());
      }
      config_->shape.through = through_;
    }
    if (!speed_.empty()) config_->hand.speed_mps = speed_option_mps("--speed", speed_);
    try {
      if (!object_motion_.empty()) set_field(fields(), "object.motion", object_motion_);
    } catch (const Error& error) {
      throw UsageError(std::string("--object-motion: ") + error.what());
    }
    if (seed_.empty()) return;
    try {
      set_field(fields(), "seed", seed_);
    } catch (const Error& error) {
      throw UsageError(std::string("--") + error.what());
    }
  }

  int run(const Observer& observer) override {
    OutputFolder folder(output_, replaceable_by({RecordingKind::kSimulated, {}}));
    if (live_) return play(folder, observer);
    const Recording recording = simulate_recording(*config_, observer, &problems_);
    write_recording(folder.path(), recording);
    observer.update("writing", 1.0);
    commit_output(folder, output_);
    report(recording);
    return kDone;
  }

 private:
  int play(OutputFolder& folder, const Observer& observer) {
    const Recording recording = simulate_live_recording(*config_, live_config_, observer, &problems_);
    for (const Problem& problem : problems_) print_error("warning: " + printable(problem.message, 600));
    LiveReport report;
    {
      LiveScan scan(recording, config_->probe, live_config_, folder.path());
      // Before anything is played: whoever started us opens what is named here.
      print_json(scan.announcement().dump_repaired());
      say(fmt::format("probe:       {}\ncamera:      {}\ncalibration: {}\nmarkers:     {}\n", scan.port(),
                      scan.camera(), scan.calibration(), scan.markers()));
      report = scan.play(observer);
      write_recording(folder.path(), scan.on_host_clock());
    }
    commit_output(folder, output_);
    print_json(live_json(report, output_).dump_repaired());
    say(live_line(report, output_));
    return report.probe_bytes_lost + report.frames_lost > 0 ? kNotTrustworthy : kDone;
  }

  void report(const Recording& recording) {
    const ProbeStream& probe = recording.probe;
    const double duration_s =
        probe.size() < 2 ? 0.0 : static_cast<double>(probe.t_ns.back() - probe.t_ns.front()) * 1e-9;
    Json out;
    out["format"] = "asperity-simulated";
    out["version"] = 1;
    out["recording"] = output_;
    out["duration_s"] = duration_s;
    out["probe_rows"] = probe.size();
    out["tracker_rows"] = recording.tracker.size();
    if (!recording.body_poses.empty()) out["object_rows"] = recording.body_poses.front().size();
    if (!problems_.empty()) out["problems"] = Json::array();
    for (const Problem& problem : problems_)
      out["problems"].push_back({{"kind", problem.kind}, {"message", printable(problem.message, 600)}});
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    for (const Problem& problem : problems_) say("warning: " + printable(problem.message, 600) + "\n");
    say(fmt::format("{}: {:.1f} s, {} probe rows, {} poses, with truth\n", printable(output_, 200), duration_s,
                    probe.size(), recording.tracker.size()));
  }

  std::string surface_ = "protoboard";
  std::string spacing_;
  std::string probe_ = "open";
  std::string material_ = "stiff";
  std::string mesh_;
  std::string mesh_unit_;
  std::string through_;
  std::string speed_;
  std::string object_motion_;
  std::string seed_;
  std::string output_;
  bool live_ = false;
  std::optional<SimulationConfig> config_;
  Problems problems_;  // of the file of heights
  LiveBenchConfig live_config_;
};

}  // namespace

std::unique_ptr<Command> make_simulate(Parser& root) { return std::make_unique<SimulateCommand>(root); }

}  // namespace asperity::app
