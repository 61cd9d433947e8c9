#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/register_scans.h"
#include "asperity/pipeline/write_registration.h"
#include "asperity/registration/manual_alignment.h"
#include "asperity/session/register_input.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

class RegisterCommand : public Command {
 public:
  explicit RegisterCommand(Parser& root)
      : Command(root, "register", "Lay scans on a 3D mesh and give it their textures") {
    require(parser().add_option("PATH... MESH", files_,
                                "Recordings, trajectory.csv files or any CSV with px_m,py_m,pz_m; then the mesh "
                                "(.obj .ply .stl .gltf .glb)"));
    parser()
        .add_option("--mesh-unit", mesh_unit_, "Length of the mesh's unit: m (the default), mm, cm, or such as 0.06m")
        ->type_name("LENGTH");
    Option* guess =
        parser()
            .add_option("--guess", guess_,
                        "x,y,z,qw,qx,qy,qz of T_mesh_world in metres, near which to begin; without any guess the whole "
                        "mesh is searched")
            ->type_name("POSE");
    Option* align = parser()
                        .add_option("--align", align_,
                                    "The guess as x,y,z,rx,ry,rz: metres, and degrees about x, the turned y and "
                                    "the twice turned z")
                        ->type_name("SIX")
                        ->excludes(guess);
    parser()
        .add_option("--picks", picks_,
                    "The guess as three or more pairs x,y,z=x,y,z;… of the path's points (m) and the mesh's (in its "
                    "unit)")
        ->type_name("PAIRS")
        ->excludes(guess)
        ->excludes(align);
    parser()
        .add_option("--texture", textures_,
                    "Texture to lay along a path instead of its own; one for all, or one a path")
        ->type_name("FILE");
    parser()
        .add_option(
            "--placement", placement_,
            "Which scans lay in the same placement of the object: auto (the default; found by their likelihood), "
            "same, each (its own), or a list with one number a path, such as 1,1,2")
        ->type_name("LIST");
    require(parser().add_option("-o,--output", output_, "Folder of the results"))->type_name("OUT");
    parser()
        .add_option("--method", method_,
                    "Of measuring, and of thesis also of registering, which needs a guess; the first is the default: " +
                        ProcessMethods::describe())
        ->type_name("NAME");
  }

  std::vector<ConfigField> fields() override { return list_fields("", config_); }

  void apply_options() override {
    try {
      if (!method_.empty()) set_field(fields(), "process.method", method_);
      if (is_placement_mode(placement_)) set_field(fields(), "placement.mode", placement_);
    } catch (const Error& error) {
      throw UsageError(std::string("--") + error.what());
    }
  }

  int run(const Observer& observer) override {
    if (files_.size() < 2) throw UsageError("PATH... MESH: at least one path and the mesh are needed");
    const std::string mesh_path = files_.back();
    files_.pop_back();
    const double unit_m = mesh_unit_.empty() ? 1.0 : unit_option_m("--mesh-unit", mesh_unit_);
    const std::optional<Pose> guess = first_pose(unit_m);
    check_paths();
    const std::vector<int> placements = placements_option();

    OutputFolder folder(output_, is_registration_folder);
    observer.update("reading", 0.0);
    reads(files_.front());
    RegisterInput input = read_register_input(files_, mesh_path, unit_m, textures_, observer);
    for (std::size_t i = 0; i < placements.size(); ++i) input.scans[i].placement = placements[i];
    const ScansOnMesh result = register_input(input, guess, config_, observer);
    reads("");
    observer.update("writing", 1.0);
    write_registration(folder.path(), result, input.scans, input.mesh, unit_m);
    const std::string json = read_file(folder.path() / "registration.json", std::uint64_t{1} << 30);
    commit_output(folder, output_);
    print_json(trim(json));
    say(summary(result) + "results in " + printable(output_, 200) + "\n");
    for (const Verdict& verdict : result.verdicts) {
      if (verdict.severity != Severity::kNote) print_error(verdict_line(verdict));
    }
    return result.trustworthy ? kDone : kNotTrustworthy;
  }

 private:
  void check_paths() const {
    try {
      check_register_input(files_, textures_);
    } catch (const Error& error) {
      throw UsageError(error.what());
    }
  }

  static bool is_placement_mode(const std::string& text) {
    return std::find(kPlacementModeNames.begin(), kPlacementModeNames.end(), text) != kPlacementModeNames.end();
  }

  // One number a path; none if they were not listed.
  std::vector<int> placements_option() const {
    if (placement_.empty() || is_placement_mode(placement_)) return {};
    const std::vector<int> out = counts_option("--placement", placement_);
    if (out.size() != files_.size()) {
      throw UsageError(fmt::format("--placement: {} numbers for {} paths", out.size(), files_.size()));
    }
    return out;
  }

  // Where to begin, however it was said.
  std::optional<Pose> first_pose(double unit_m) const {
    if (!guess_.empty()) return pose_option("--guess", guess_);
    if (!align_.empty()) return align_manually(alignment_option("--align", align_));
    if (picks_.empty()) return std::nullopt;
    const PickedPairs pairs = pairs_option("--picks", picks_, unit_m);
    try {
      return align_picked(pairs.p_world_m, pairs.p_mesh_m).T_b_a;
    } catch (const Error& error) {
      throw UsageError(std::string("--picks: ") + error.what());
    }
  }

  static std::string pose_text(const Pose& pose) {
    const Eigen::Vector3d& p = pose.translation_m;
    const Eigen::Quaterniond& q = pose.rotation;
    return fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(),
                       q.z());
  }

  static std::string pose_lines(const RegistrationResult& registration) {
    std::string out = fmt::format(
        "registration  {} points, {} outliers, residual {:.3f} mm RMS, {} after {} iterations ({})\n"
        "T_mesh_world  {}\n",
        registration.points, registration.outliers, registration.rms_m * 1e3,
        registration.converged ? "converged" : "not converged", registration.iterations,
        kStopRuleNames.at(static_cast<std::size_t>(registration.stopped_by)), pose_text(registration.T_mesh_world));
    for (const UndeterminedMotion& motion : registration.undetermined) {
      out += "undetermined  " + motion.description + "\n";
    }
    if (registration.runner_up) {
      const RunnerUp& other = *registration.runner_up;
      out += fmt::format("runner-up     residual {:.3f} mm RMS, {:.1f} mm and {:.1f} degrees away\n", other.rms_m * 1e3,
                         other.distance_m * 1e3, other.rotation_rad * 180.0 / std::numbers::pi);
    }
    if (!registration.verdict.empty()) out += "verdict       " + registration.verdict + "\n";
    return out;
  }

  static std::string summary(const ScansOnMesh& result) {
    std::string out;
    for (std::size_t k = 0; k < result.placements.size(); ++k) {
      if (result.placements.size() > 1) {
        const std::size_t count = result.placements[k].scans.size();
        out += fmt::format("placement {}   {} {}\n", k + 1, count, count == 1 ? "scan" : "scans");
      }
      out += pose_lines(result.placements[k].registration);
    }
    for (std::size_t i = 0; i < result.scans.size(); ++i) {
      const RegisteredScan& scan = result.scans[i];
      const double length_mm = scan.path.s_m.empty() ? 0.0 : (scan.path.s_m.back() - scan.path.s_m.front()) * 1e3;
      out += fmt::format("{}\n  path        {:.2f} mm on the mesh, {} triangles", printable(scan.name, 200), length_mm,
                         i < result.coordinates.warps.size() ? result.coordinates.warps[i].triangles : 0);
      if (scan.path_texture) {
        out += fmt::format(", texture {} harmonics, {:.1f} µm RMS, model error {:.1f} µm",
                           scan.path_texture->series.fit.texture.a_m.size(),
                           scan.path_texture->series.fit.rms_height_m * 1e6,
                           scan.path_texture->series.fit.rms_error_m * 1e6);
      }
      out += "\n";
      if (result.placements.size() > 1) {
        out += fmt::format("  placement   {}, T_mesh_world {}\n", scan.placement + 1,
                           pose_text(result.registration_of(scan).T_mesh_world));
      }
      if (scan.process.accuracy && scan.process.accuracy->profile) {
        const ProfileComparison& truth = *scan.process.accuracy->profile;
        out += !std::isfinite(truth.correlation)
                   ? "  truth       nothing to compare\n"
                   : fmt::format("  truth       correlation {:.3f}, gain {:.3f}, {:.1f} µm RMS, length {:+.2f} %\n",
                                 truth.correlation, truth.gain, truth.rms_um, truth.length_error_percent);
      }
      for (const Problem& problem : scan.process.problems) out += "  note        " + problem.message + "\n";
    }
    for (const Problem& problem : result.problems) out += "note          " + problem.message + "\n";
    return out;
  }

  std::vector<std::string> files_, textures_;
  std::string mesh_unit_, guess_, align_, picks_, output_, method_, placement_;
  RegisterConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_register(Parser& root) { return std::make_unique<RegisterCommand>(root); }

}  // namespace asperity::app
