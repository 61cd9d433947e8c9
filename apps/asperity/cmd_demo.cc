#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/json/parse_json.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/true_profile.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/recording/write_recording.h"
#include "asperity/simulation/simulate_recording.h"
#include "commands.h"
#include "demo_feel.h"
#include "demo_mesh.h"
#include "demo_metric.h"
#include "demo_scanner.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;
constexpr const char* kMark = "demo.json";

bool is_demo_folder(const fs::path& folder) {
  try {
    const Json json = parse_json_or_null(read_file(folder / kMark, 1 << 20));
    return json.is_object() && json.value("format", "") == "asperity-demo";
  } catch (const Error&) {
    return false;
  }
}

struct Scan {
  std::string name;
  std::string title;
  SimulationConfig simulation;
};

Scan make_scan(const std::string& surface, const std::string& title) {
  Scan scan{surface, title, make_simulation_config(surface, "open")};
  scan.simulation.hand.speed_mps = 0.025;
  scan.simulation.hand.length_m = 0.12;
  return scan;
}

// The sandpaper has a soft backing, so that there is a stiffness to measure.
std::vector<Scan> make_scans(bool full) {
  constexpr double kBacking_N_per_m = 2000.0;
  std::vector<Scan> scans{make_scan("protoboard", "protoboard"), make_scan("sandpaper", "sandpaper on foam")};
  scans.back().simulation.contact.stiffness_N_per_m = kBacking_N_per_m;
  scans.back().simulation.contact.damping_ratio = 0.5;
  if (full) {
    for (const char* surface : {"sine", "cable_tie", "clay_pot"}) scans.push_back(make_scan(surface, surface));
  }
  return scans;
}

std::vector<DemoMetric> compare_scan(const Scan& scan, const Recording& recording, const ProcessResult& result,
                                     const ProcessConfig& config) {
  const Profile truth = true_profile(*recording.truth, config.profile);
  const Periodicity pattern = find_periodicity(truth.texture_m, truth.spacing_m, config.periodicity);
  const RoughnessResult roughness = measure_roughness(truth.texture_m, truth.spacing_m, config.roughness);
  std::vector<DemoMetric> metrics;
  if (pattern.periodic) {
    metrics.push_back({"pitch_m", "pitch", "mm", 1e3, result.periodicity.pitch_m, result.periodicity.pitch_stderr_m,
                       DemoMetric::kNone, scan.simulation.surface.pitch_m});
    metrics.push_back({"depth_m", "depth", "µm", 1e6, result.periodicity.depth_m, result.periodicity.depth_stderr_m,
                       DemoMetric::kNone, pattern.depth_m});
  }
  metrics.push_back(rq_metric(result, roughness.Rq_m));
  const StiffnessEstimate& stiffness = result.stiffness;
  const double k_N_per_m = scan.simulation.contact.stiffness_N_per_m;
  if (stiffness.measured) {
    metrics.push_back({"stiffness_N_per_m", "contact stiffness", "N/mm", 1e-3, 1e3 * stiffness.stiffness_N_per_mm,
                       1e3 * stiffness.stiffness_stderr_N_per_mm, DemoMetric::kNone, k_N_per_m});
  } else {
    metrics.push_back({"stiffness_N_per_m", "contact stiffness", "N/mm", 1e-3, DemoMetric::kNone, DemoMetric::kNone,
                       1e3 * stiffness.lower_bound_N_per_mm, k_N_per_m});
  }
  if (result.accuracy && result.accuracy->profile) {
    metrics.push_back({"correlation", "correlation", "", 1.0, result.accuracy->profile->correlation, DemoMetric::kNone,
                       DemoMetric::kNone, 1.0});
    metrics.push_back(
        {"gain", "gain", "", 1.0, result.accuracy->profile->gain, DemoMetric::kNone, DemoMetric::kNone, 1.0});
    metrics.push_back(length_error_metric(result));
  }
  return metrics;
}

class DemoCommand : public Command {
 public:
  explicit DemoCommand(Parser& root)
      : Command(root, "demo",
                "Simulate scans of two surfaces and of a mesh, process, register and render them, and compare with the "
                "truth") {
    parser().add_flag("--full", full_, "All five surfaces, and the scanner: calibrated, live and end to end");
    require(parser().add_option("-o,--output", output_, "Folder of the recordings and results"))->type_name("DIR");
  }

  std::vector<ConfigField> fields() override { return list_fields("", config_); }

  int run(const Observer& observer) override {
    OutputFolder folder(output_, is_demo_folder);
    Json out;
    out["format"] = "asperity-demo";
    out["version"] = 1;
    out["asperity"] = kVersion;
    std::string text = fmt::format("{:<22}{:>18} {:>12}\n", "", "measured", "true");
    bool trustworthy = true;
    std::optional<ProcessResult> protoboard;
    double true_pitch_m = 0.0;
    for (const Scan& scan : make_scans(full_)) {
      const Recording recording = simulate_recording(scan.simulation, observer);
      const fs::path recording_folder = folder.path() / "recordings" / scan.name;
      const fs::path result_folder = folder.path() / "results" / scan.name;
      fs::create_directories(recording_folder);
      fs::create_directories(result_folder);
      write_recording(recording_folder, recording);
      const ProcessResult result = process_recording(recording, config_, observer);
      write_result(result_folder, result, recording, scan.name);
      const std::vector<DemoMetric> metrics = compare_scan(scan, recording, result, config_);
      out["surfaces"][scan.name] = metrics_json(metrics);
      text += scan.title + "\n";
      for (const DemoMetric& metric : metrics) text += metric_line(metric);
      if (!result.verdict.empty()) print_error(scan.name + ": " + result.verdict);
      trustworthy &= result.trustworthy;
      if (scan.name == "protoboard") {
        protoboard = result;
        true_pitch_m = scan.simulation.surface.pitch_m;
      }
    }
    if (!protoboard || !protoboard->texture)
      throw Error("demo: with these settings the protoboard has no texture to paint with");
    const MeshDemo mesh = demonstrate_mesh(folder.path(), config_, *protoboard->texture, observer);
    out["mesh"] = mesh.json;
    text += mesh.text;
    if (!mesh.verdict.empty()) print_error("pebble: " + mesh.verdict);
    trustworthy &= mesh.trustworthy;
    const FeelDemo felt = demonstrate_feel(folder.path(), *protoboard, true_pitch_m, observer);
    out["feel"] = felt.json;
    text += felt.text;
    if (!felt.trustworthy) print_error("feel: invalid: " + felt.verdict);
    trustworthy &= felt.trustworthy;
    if (full_) {
      const ScannerDemo scanner = demonstrate_scanner(folder.path() / "scanner", config_, observer);
      out["scanner"] = scanner.json;
      text += scanner.text;
      if (!scanner.trustworthy) print_error("scanner: invalid: " + scanner.verdict);
      trustworthy &= scanner.trustworthy;
    }
    const std::string json = out.dump_repaired(2);
    write_file(folder.path() / kMark, json + "\n");
    observer.update("writing", 1.0);
    commit_output(folder, output_);
    print_json(json);
    const std::string where = printable(output_, 200);
    say(text + fmt::format("\n{0}/recordings/   the raw streams and the truth\n{0}/results/      profile.csv, "
                           "texture.json, result.json, trajectory.csv of each; of the pebble also the textured "
                           "mesh\n{0}/painted/      the pebble with both textures\n{0}/felt/         the rendered "
                           "plate, the log of the stroke and a picture of its force\n",
                           where));
    return trustworthy ? kDone : kNotTrustworthy;
  }

 private:
  bool full_ = false;
  std::string output_;
  ProcessConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_demo(Parser& root) { return std::make_unique<DemoCommand>(root); }

}  // namespace asperity::app
