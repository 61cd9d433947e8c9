#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/crc32.h"
#include "asperity/base/csv.h"
#include "asperity/base/folder_content.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/import/format_import.h"
#include "asperity/import/import_mapped.h"
#include "asperity/import/measure_stroke_evidence.h"
#include "asperity/import/read_stroke.h"
#include "asperity/import/stroke_file.h"
#include "asperity/json/config_json.h"
#include "asperity/recording/import_imu_pose.h"
#include "asperity/recording/recording_source.h"
#include "asperity/recording/write_recording.h"
#include "asperity/session/our_folder.h"
#include "asperity/verdict/judge_stroke.h"
#include "commands.h"
#include "config_file.h"
#include "option_units.h"
#include "stroke_input.h"

namespace asperity::app {

namespace {

// An option that stands for a setting as it is.
struct SettingOption {
  const char* option;
  const char* setting;
  const char* type;
  const char* description;
};

constexpr SettingOption kSettingOptions[] = {
    {"--columns", "mapping.columns", "TEXT", "What the columns mean: \"t=Time[ms], px=X[mm], ax=#5[g], …\""},
    {"--pose-columns", "mapping.pose.columns", "TEXT", "Columns of the poses' file alone"},
    {"--imu-columns", "mapping.imu.columns", "TEXT", "Columns of the inertial sensor's file"},
    {"--gyro-columns", "mapping.gyro.columns", "TEXT", "Columns of the gyroscope's file"},
    {"--force-columns", "mapping.force.columns", "TEXT", "Columns of the force's file"},
    {"--preset", "mapping.pose.preset", "NAME", "Program that wrote the poses, or none; default: by their content"},
    {"--imu-preset", "mapping.imu.preset", "NAME", "Program that wrote the inertial sensor's file"},
    {"--force-preset", "mapping.force.preset", "NAME", "Program that wrote the force's file"},
    {"--body", "mapping.pose.body", "NAME", "The body, where a file has several"},
    {"--euler", "mapping.euler", "ORDER", "Order of Euler angles: xyz, zyx, …"},
    {"--euler-axes", "mapping.euler_axes", "KIND", "intrinsic (each about the rotated axis) or extrinsic"},
    {"--quaternion", "mapping.quaternion", "ORDER", "Order in a range of columns: xyzw or wxyz"},
    {"--up", "mapping.up", "AXIS", "The world's axis that points up: x, y, z, -x, -y, -z"},
    {"--imu-axes", "mapping.imu_axes", "AXES", "The sensor's axes that are the body's: y,-x,z; or qw,qx,qy,qz"},
    {"--clocks", "mapping.clocks", "CHOICE", "one, separate (offset and drift are estimated) or auto"},
    {"--pose-file-rate", "mapping.pose.rate_Hz", "HZ", "Rate of poses without times"},
    {"--imu-rate", "mapping.imu.rate_Hz", "HZ", "Rate of inertial samples without times"},
    {"--gyro-rate", "mapping.gyro.rate_Hz", "HZ", "Rate of a gyroscope's samples without times"},
    {"--force-rate", "mapping.force.rate_Hz", "HZ", "Rate of force samples without times"},
    {"--pose-rate", "import.pose_rate_Hz", "HZ", "Thin the poses to this rate, Hz"},
    {"--seed", "import.seed", "N", "Random seed of the noise"},
};

class ImportCommand : public Command {
 public:
  explicit ImportCommand(Parser& root)
      : Command(root, "import", "Make a recording from tables of other programs: poses, an inertial sensor, a force") {
    parser()
        .add_option("--pose", pose_, "Table with the poses; with all data, if it is the only file")
        ->type_name("FILE");
    parser()
        .add_option("--imu", imu_, "Table with the accelerometer and the gyroscope; with --stroke also one an axis")
        ->one_value_each()
        ->type_name("FILE");
    parser().add_option("--gyro", gyro_, "Table with the gyroscope, where it has one of its own")->type_name("FILE");
    parser().add_option("--force", force_, "Table with the force")->type_name("FILE");
    parser()
        .add_option("--object-pose", object_pose_, "Poses of the object, where it moves: the scan is relative to it")
        ->type_name("FILE");
    settings_.resize(std::size(kSettingOptions));
    const std::vector<ConfigField> known = ImportCommand::fields();
    for (std::size_t i = 0; i < std::size(kSettingOptions); ++i) {
      const SettingOption& option = kSettingOptions[i];
      parser()
          .add_option(option.option, settings_[i], option.description)
          ->type_name(option.type)
          ->suggest(find_field(known, option.setting).choices);
    }
    parser().add_flag("--invert-rotation", invert_, "The rotations are from the world to the body");
    parser().add_flag("--left-handed", left_handed_, "The world's and the body's axes are left-handed");
    parser().add_option("--tip", tip_, "The tip in the body's axes: 0mm,0mm,-120mm")->type_name("X,Y,Z");
    parser().add_option("--pose-noise", noise_, "Add noise along the world's axes")->type_name("X,Y,Z");
    parser()
        .add_option("--tracker-sigma", sigma_, "White noise of a pose's position on each axis; default: estimated")
        ->type_name("LENGTH");
    parser()
        .add_option("--tracker-sigma-deg", sigma_deg_, "White noise of a pose's rotation about each axis, degrees")
        ->type_name("DEGREES");
    parser().add_option("--mapping", mapping_file_, "Read the mapping from a file")->type_name("FILE.toml");
    parser()
        .add_option("--save-mapping", save_mapping_, "Write the mapping with the values that were guessed")
        ->type_name("FILE.toml");
    parser().add_flag("--stroke", stroke_,
                      "A stroke without orientations, for textures and spectra: an acceleration of one to three axes, "
                      "and what there is of positions and force; for one column: --stroke --imu acc.txt "
                      "--imu-columns \"ax=#1[g]\" --imu-rate 10000 -o STROKE");
    parser()
        .add_option("--stroke-speed", stroke_speed_, "Speed of a stroke without positions, as the hand held it")
        ->type_name("SPEED");
    parser()
        .add_option("--stroke-force", stroke_force_,
                    "Force of a stroke without a force sensor, as the hand held it, such as 1N")
        ->type_name("FORCE");
    parser().add_flag("--dry-run", dry_run_, "Print the meaning of each column, and write nothing");
    parser().add_flag("--unchecked", unchecked_, "Import in spite of implausible units or axes");
    parser().add_option("-o,--output", output_, "The recording's folder")->type_name("REC");
  }

  std::vector<ConfigField> fields() override {
    std::vector<ConfigField> out = list_fields("import", config_);
    for (ConfigField& field : list_fields("mapping", mapping_)) out.push_back(std::move(field));
    for (ConfigField& field : list_fields("stroke", stroke_config_)) out.push_back(std::move(field));
    return out;
  }

  void apply_options() override {
    if (!mapping_file_.empty()) load_config_file(mapping_file_, fields());
    if (!stroke_speed_.empty()) stroke_config_.speed_mps = speed_option_mps("--stroke-speed", stroke_speed_);
    constexpr double kMostForce_N = 1e3;
    if (!stroke_force_.empty()) stroke_config_.force_N = force_option_N("--stroke-force", stroke_force_, kMostForce_N);
    if (!noise_.empty()) config_.pose_noise_m = lengths_option_m("--pose-noise", noise_);
    if (!sigma_.empty())
      config_.tracker_sigma_m = positive("--tracker-sigma", length_option_m("--tracker-sigma", sigma_));
    if (!sigma_deg_.empty()) {
      constexpr double kMost_deg = 57.0, kDegree_rad = 0.017453292519943295;
      config_.tracker_sigma_rad =
          kDegree_rad *
          positive("--tracker-sigma-deg", number_option("--tracker-sigma-deg", sigma_deg_, "deg", 0.0, kMost_deg));
    }
    if (!tip_.empty()) {
      const Eigen::Vector3d tip = point_option_m("--tip", tip_);
      constexpr double kFarthest_m = 10.0;
      if (tip.cwiseAbs().maxCoeff() > kFarthest_m)
        throw UsageError("--tip: farther than 10 m; lengths need their unit, as 0mm,100mm,10mm");
      mapping_.tip_m = {tip.x(), tip.y(), tip.z()};
    }
    mapping_.invert_rotation = mapping_.invert_rotation || invert_;
    mapping_.left_handed = mapping_.left_handed || left_handed_;
    try {
      for (std::size_t i = 0; i < std::size(kSettingOptions); ++i) {
        if (settings_[i].empty()) continue;
        // Texts as they are: they hold what --set would take for quotes and lists.
        const ConfigField& field = find_field(list_once_ = fields(), kSettingOptions[i].setting);
        if (field.type == FieldType::kText) {
          field.set(settings_[i]);
        } else {
          field.set_text(settings_[i]);
        }
      }
    } catch (const Error& error) {
      throw UsageError(error.what());
    }
  }

  int run(const Observer& observer) override {
    if (output_.empty() && !dry_run_) throw UsageError("--output is required, or --dry-run");
    if (stroke_) return run_stroke();
    if (pose_.empty()) throw UsageError("--pose is required, or --stroke for an acceleration without poses");
    if (imu_.size() > 1) throw UsageError("--imu: several files need --stroke");
    const ImportFiles files{pose_, imu_file(), gyro_, force_, object_pose_};
    if (!dry_run_ && save_mapping_.empty() && is_same_config(mapping_, MappingConfig{}) && has_fixed_columns(files)) {
      return run_fixed(observer);
    }
    ImportTables tables = read_import_tables(files, mapping_);
    observer.update("importing", 0.4);
    const ImportedMotion motion = read_imported_motion(tables, mapping_);
    observer.update("importing", 0.7);
    if (dry_run_) return show(tables, motion);
    if (!unchecked_) refuse_doubts(tables, motion);
    Recording recording = make_imported_recording(motion, tables, mapping_, config_);
    if (unchecked_) {
      for (const ImportDoubt& doubt : motion.checks.doubts) {
        recording.problems.push_back({"implausible", doubt_text(doubt, tables), 1});
        ++recording.info.problems["implausible"];
      }
    }
    if (!save_mapping_.empty()) save(tables, motion);
    OutputFolder folder(output_, replaceable_by(source_of(recording)));
    write_recording(folder.path(), recording);
    observer.update("importing", 1.0);
    commit_output(folder, output_);
    Json details = import_json(tables, motion);
    report(recording, recording.problems,
           import_summary_text(tables) + import_checks_text(motion) +
               tracker_sigma_text(tracker_sigma(motion.noise, config_)),
           &details);
    return kDone;
  }

 private:
  static double positive(const char* option, double value) {
    if (!(value > 0.0)) throw UsageError(std::string(option) + ": must be above 0");
    return value;
  }

  std::string imu_file() const { return imu_.empty() ? std::string() : imu_.front(); }

  int run_stroke() {
    if (pose_.empty() && imu_.empty()) throw UsageError("--stroke needs --imu, or --pose for one file with all");
    if (!gyro_.empty() || !object_pose_.empty() || !save_mapping_.empty())
      throw UsageError("--stroke excludes --gyro, --object-pose and --save-mapping");
    StrokeReading reading = read_stroke({{imu_.begin(), imu_.end()}, pose_, force_}, mapping_, stroke_config_);
    std::string text = stroke_columns_text(reading.tables);
    if (!dry_run_ && !unchecked_ && !reading.doubts.empty()) {
      std::string doubts;
      for (const std::string& doubt : reading.doubts) doubts += (doubts.empty() ? "" : "\n  ") + doubt;
      throw Error(doubts + "\n  (--dry-run prints the columns; --unchecked imports in spite of this)");
    }
    if (dry_run_) {
      text += stroke_text(reading.stroke);
      for (const std::string& doubt : reading.doubts) text += "implausible " + doubt + "\n";
      say(text);
      if (!reading.doubts.empty() && !unchecked_) return kBadInput;
      return is_trustworthy(judge_stroke(measure_stroke_evidence(reading.stroke))) ? kDone : kNotTrustworthy;
    }
    for (const std::string& doubt : reading.doubts) reading.stroke.problems.push_back({"implausible", doubt, 1});
    const std::vector<StrokeOrigin> origins = stroke_origins(reading.tables);
    OutputFolder folder(output_, [&](const std::filesystem::path& old) {
      const bool is_ours = naming_added(is_our_folder)(old);
      if (is_ours) refuse_other_stroke(old, origins);
      return is_ours;
    });
    Json out = asperity::write_stroke(folder.path(), reading.stroke, origins);
    write_listing(folder.path());
    commit_output(folder, output_);
    out["unused"] = unused_columns_json(pointers_to(reading.tables));
    const bool trustworthy = out.at("trustworthy").get<bool>();
    out["stroke"] = output_;
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    say(text + stroke_text(reading.stroke) + stroke_heights_text(reading.stroke));
    return trustworthy ? kDone : kNotTrustworthy;
  }

  static void refuse_other_stroke(const std::filesystem::path& folder, const std::vector<StrokeOrigin>& origins) {
    const std::string other = source_beyond(folder, origins);
    if (other.empty()) return;
    throw Error(
        printable(folder.string(), 200) + ": holds " + other +
        ", which is replaced only by an import of the same files, unchanged; nothing was changed. Choose another "
        "output folder, or move this one elsewhere");
  }

  // The one form of file that needs no mapping.
  int run_fixed(const Observer& observer) {
    ImportInput input = read_imu_pose(imu_file(), pose_, object_pose_);
    observer.update("importing", 0.5);
    const TrackerSigma sigma = tracker_sigma(estimate_pose_noise({input.pose_t_ns, input.T_world_body}), config_);
    input.sigma_position_m = sigma.position_m;
    input.sigma_rotation_rad = sigma.rotation_rad;
    Recording recording = import_imu_pose(input, config_);
    recording.calibration.extra["tracker_sigma_from"] = {{"position", sigma.position_from},
                                                         {"rotation", sigma.rotation_from}};
    recording.info.extra["import_origin"] = fixed_origin();
    OutputFolder folder(output_, replaceable_by(source_of(recording)));
    write_recording(folder.path(), recording);
    observer.update("importing", 1.0);
    commit_output(folder, output_);
    report(recording, input.problems, tracker_sigma_text(sigma), nullptr);
    return kDone;
  }

  // The files, as make_imported_recording states them.
  Json fixed_origin() const {
    Json files = Json::array();
    for (const auto& [role, file] :
         {std::pair("poses", pose_), std::pair("inertial sensor", imu_file()), std::pair("poses", object_pose_)}) {
      if (file.empty()) continue;
      const std::string bytes = read_file(file, ReadLimits{}.csv_bytes);
      files.push_back({{"role", role},
                       {"file", std::filesystem::path(file).filename().string()},
                       {"bytes", bytes.size()},
                       {"crc32", fmt::format("{:08x}", crc32(bytes))}});
    }
    return {{"files", std::move(files)}};
  }

  void refuse_doubts(const ImportTables& tables, const ImportedMotion& motion) const {
    std::string text;
    for (const ImportDoubt& doubt : motion.checks.doubts) {
      text += (text.empty() ? "" : "\n  ") + doubt_text(doubt, tables);
    }
    // Rows that were put in order may be the cause.
    for (const Problem& problem : motion.streams.problems) {
      if (!text.empty() && problem.kind == "time_backwards") text += "\n  " + problem.message;
    }
    if (!text.empty()) throw Error(text + "\n  (--dry-run prints the columns; --unchecked imports in spite of this)");
  }

  int show(const ImportTables& tables, const ImportedMotion& motion) {
    if (!save_mapping_.empty()) save(tables, motion);
    Json out = import_json(tables, motion);
    out["format"] = "asperity-import-plan";
    out["version"] = 1;
    print_json(out.dump_repaired(2));
    std::string text = import_table_text(tables) + import_checks_text(motion);
    text += tracker_sigma_text(tracker_sigma(motion.noise, config_));
    for (const Problem& problem : motion.streams.problems) text += "note        " + problem.message + "\n";
    for (const ImportDoubt& doubt : motion.checks.doubts) text += "implausible " + doubt_text(doubt, tables) + "\n";
    say(text);
    return motion.checks.doubts.empty() || unchecked_ ? kDone : kBadInput;
  }

  void save(const ImportTables& tables, const ImportedMotion& motion) {
    // Only a mapping is replaced, never data.
    if (std::filesystem::exists(save_mapping_)) {
      const bool is_file = std::filesystem::is_regular_file(save_mapping_);
      if (!is_file || read_file(save_mapping_, ReadLimits{}.csv_bytes).find("[mapping") == std::string::npos)
        throw Error(printable(save_mapping_, 200) + ": exists and is not a mapping; nothing was changed");
    }
    MappingConfig stated = stated_mapping(tables, mapping_, motion);
    write_file(save_mapping_, to_toml(list_fields("mapping", stated), true));
  }

  void report(const Recording& recording, const Problems& problems, const std::string& mapped, const Json* details) {
    Json out;
    out["format"] = "asperity-imported";
    out["version"] = 1;
    out["recording"] = output_;
    out["probe_rows"] = recording.probe.size();
    out["tracker_rows"] = recording.tracker.size();
    if (!recording.body_poses.empty()) out["object_rows"] = recording.body_poses.front().size();
    if (details != nullptr) out["mapped"] = *details;
    out["problems"] = Json::array();
    std::string text = mapped + fmt::format("{}: {} probe rows, {} poses\n", printable(output_, 200),
                                            recording.probe.size(), recording.tracker.size());
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

  std::vector<std::string> imu_;
  std::string pose_;
  std::string gyro_;
  std::string force_;
  std::string object_pose_;
  std::vector<std::string> settings_;
  std::vector<ConfigField> list_once_;
  bool invert_ = false;
  bool left_handed_ = false;
  std::string tip_;
  std::string noise_;
  std::string sigma_;
  std::string sigma_deg_;
  std::string mapping_file_;
  std::string save_mapping_;
  bool stroke_ = false;
  std::string stroke_speed_;
  std::string stroke_force_;
  StrokeImportConfig stroke_config_;
  bool dry_run_ = false;
  bool unchecked_ = false;
  std::string output_;
  ImportConfig config_;
  MappingConfig mapping_;
};

}  // namespace

std::unique_ptr<Command> make_import(Parser& root) { return std::make_unique<ImportCommand>(root); }

}  // namespace asperity::app
