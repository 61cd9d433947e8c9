#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/device/cap_scene.h"
#include "asperity/device/servo_loop.h"
#include "asperity/device/write_flight_record.h"
#include "asperity/pipeline/config_json.h"
#include "asperity/pipeline/score_rendering.h"
#include "asperity/scene/height_map_viewer.h"
#include "asperity/scene/read_scene.h"
#include "asperity/texture/read_height_image.h"
#include "commands.h"
#include "feel_device.h"
#include "feel_drive.h"
#include "feel_log.h"
#include "feel_report.h"
#include "feel_settings.h"
#include "feel_verdict.h"
#include "interrupt.h"
#include "option_units.h"
#include "our_file.h"
#include "our_folder.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kTile_mm = 10.0, kHeightRange_mm = 2.5;
constexpr std::array<const char*, 4> kEndNames{"duration", "device_ended", "stopped", "fault"};

class FeelCommand : public Command {
 public:
  explicit FeelCommand(CLI::App& root)
      : Command(root, "feel", "Feel a scene with a haptic device, or log what it would") {
    parser().add_option("SCENE", scene_, "A scene.json, a folder that has one, or a mesh without textures");
    parser()
        .add_option("--height-maps", height_map_list_,
                    "Instead of SCENE: images side by side on a plane, a.png,b.png,…")
        ->type_name("FILES");
    parser().add_option("--tile", tile_, "Side of a height map's tile; 10mm")->type_name("LENGTH");
    parser().add_option("--height-range", height_range_, "From black to white; 2.5mm")->type_name("LENGTH");
    parser()
        .add_option("--device", device_,
                    "sim (the default: a modelled hand), replay (the default with --replay), haply, openhaptics, dhd, "
                    "2diy, audio or gamepad")
        ->type_name("NAME");
    parser()
        .add_option("--replay", replay_,
                    "trajectory.csv whose positions the device point takes exactly, in the scene's world; or a "
                    "recording, repeated where the scene has it registered")
        ->type_name("FILE|REC");
    parser().add_flag("--mapped", mapped_, "The positions of --replay are in the tracker's world");
    parser().add_option("--rate", rate_, "Of the servo, Hz; 1000")->type_name("HZ");
    parser().add_option("--log", log_, "Write a row a tick")->type_name("FILE.csv");
    parser()
        .add_option("--duration", duration_, "Stop after this time; else at the path's end, or until interrupted")
        ->type_name("TIME");
    parser().add_flag("--timing", timing_, "Time each step: a column step_ns in the log");
    parser().add_flag("--realtime", realtime_, "By the clock also where nobody is there to feel it (sim, replay)");
    parser()
        .add_option("--mesh-unit", mesh_unit_, "Of a mesh given alone: m (the default), mm, or such as 0.06m")
        ->type_name("LENGTH");
    parser().add_option("--tip", tip_, "Radius of the tip; a point")->type_name("LENGTH");
    parser()
        .add_option("--texture-model", model_,
                    "height, normal-perturbation, lateral-gradient, stochastic, autoregressive or decaying-sinusoids, "
                    "for all textures; auto: each its own")
        ->type_name("NAME");
    parser().add_option("--stiffness", stiffness_, "Where the scene knows none, N/m; 1000")->type_name("K");
    parser().add_option("--friction", friction_, "Coefficient where the scene knows none; 0")->type_name("MU");
    parser().add_option("--from", from_, "sim: where the stroke begins, x,y,z in m or with units")->type_name("POINT");
    parser().add_option("--to", to_, "sim: where it turns; without both, along the texture")->type_name("POINT");
    parser().add_option("--press", press_, "sim: force of the hand; 1N")->type_name("FORCE");
    parser().add_option("--speed", speed_, "sim: of the stroke; 50mm/s")->type_name("SPEED");
    parser()
        .add_option("-o,--output", output_, "Folder of result.json, and of the log unless --log says where")
        ->type_name("OUT");
  }

  std::vector<ConfigField> fields() override { return feel_fields(settings_); }

  void apply_options() override {
    if (!rate_.empty()) set("--rate", "servo.rate_Hz", number_option("--rate", rate_, "Hz", 100.0, 4000.0));
    if (!duration_.empty()) settings_.servo.duration_s = duration_option_s("--duration", duration_, 36'000.0);
    if (timing_) settings_.servo.timed = true;
    if (realtime_) settings_.servo.paced = true;
    if (!tip_.empty()) set("--tip", "render.tip_radius_m", length_option_m("--tip", tip_));
    if (!stiffness_.empty()) {
      set("--stiffness", "render.stiffness_N_per_m", number_option("--stiffness", stiffness_, "N/m", 1.0, 1e6));
    }
    if (!friction_.empty()) {
      set("--friction", "render.friction", number_option("--friction", friction_, "", 0.0, 10.0));
    }
    if (!press_.empty()) set("--press", "stroke.press_N", force_option_N("--press", press_, 50.0));
    if (!speed_.empty()) set("--speed", "stroke.speed_mps", speed_option_mps("--speed", speed_));
    if (!model_.empty()) set_text("--texture-model", "render.texture.model", model_);
  }

  int run(const Observer& observer) override {
    choose_scene();
    choose_device();
    std::optional<OutputFolder> folder;
    if (!output_.empty()) folder.emplace(output_, is_our_folder);
    observer.update("reading", 0.0);
    Scene scene = read_felt_scene();
    FeelDrive drive;
    if (!replay_.empty()) {
      drive = read_drive(replay_, mapped_, scene, settings_, observer);
    } else if (kind_.driven) {
      drive = tile_stroke_m_ ? make_drive(scene, tile_stroke_m_->front(), tile_stroke_m_->back(), settings_)
                             : make_drive(scene, point("--from", from_), point("--to", to_), settings_);
    }
    if (settings_.servo.duration_s > 0.0) cut_drive(drive, settings_.servo.duration_s, settings_.servo.rate_Hz);
    warn_of(scene.problems);
    warn_of(drive.problems);
    const std::unique_ptr<HapticDevice> device = open_device(device_, drive, settings_);
    observer.update("scene", 0.0);
    SnapshotExchange<const RenderModel> model(make_model(scene, *device));
    const fs::path log = !log_.empty() ? fs::path(log_) : folder ? folder->path() / "log.csv" : fs::path();
    const ServoResult servo = feel(*device, model, log, observer);
    const RunVerdict run = judge_run(figures_, servo, *device, drive, *model.acquire(), settings_.servo.safety);
    warnings_.insert(warnings_.end(), run.warnings.begin(), run.warnings.end());
    warnings_.insert(warnings_.end(), notes_.begin(), notes_.end());
    for (const std::string& doubt : run.doubts) distrust(doubt);
    std::optional<RenderingScore> score;
    if (drive.scan && servo.end != ServoEnd::kFault) {
      score = score_rendering(drive.scan->measured, drive.scan->pressed, *model.acquire(), settings_.servo.rate_Hz,
                              settings_.score, observer);
      if (!score->trustworthy) distrust("real against rendered: " + score->verdict);
    }
    const std::string json = to_json(servo, *device, score).dump(2, ' ', false, Json::error_handler_t::replace);
    if (folder) {
      write_file(folder->path() / "result.json", json + "\n");
      write_listing(folder->path());
      folder->commit();
    }
    print_json(json);
    report(servo, score);
    if (servo.end == ServoEnd::kStopped) return interrupt_exit_code();
    return verdict_.empty() ? kDone : kNotTrustworthy;
  }

 private:
  // An option's value into the setting that it stands for, within that one's range.
  void set_text(const std::string& option, const std::string& setting, const std::string& value) {
    try {
      set_field(fields(), setting, value);
    } catch (const Error& error) {
      throw UsageError(option + ": " + error.what());
    }
  }
  void set(const std::string& option, const std::string& setting, double value) {
    set_text(option, setting, number_text(value));
  }

  void choose_scene() {
    if (scene_.empty() == height_map_list_.empty())
      throw UsageError(scene_.empty() ? "SCENE is missing" : "--height-maps stands instead of SCENE");
    for (std::string_view rest = height_map_list_; !height_map_list_.empty();) {
      const auto comma = rest.find(',');
      height_maps_.emplace_back(rest.substr(0, comma));
      if (height_maps_.back().empty()) throw UsageError("--height-maps: a file's name is empty");
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    for (const auto& [option, text] : {std::pair{"--tile", &tile_}, std::pair{"--height-range", &height_range_}}) {
      if (!text->empty() && height_map_list_.empty()) throw UsageError(std::string(option) + " needs --height-maps");
    }
    if (!mesh_unit_.empty() && scene_.empty()) throw UsageError("--mesh-unit needs a mesh");
    if (parser().count("--log") > 0 && (log_.empty() || log_ == "-"))
      throw UsageError("--log: a file's name is needed");
    std::vector<std::string> inputs = height_maps_;
    inputs.insert(inputs.end(), {scene_, replay_});
    if (!log_.empty()) refuse_stranger(log_, kFeelLogColumns, inputs);
  }

  void choose_device() {
    if (device_.empty()) device_ = replay_.empty() ? "sim" : "replay";
    if (device_ == "mouse") throw UsageError("--device mouse: the mouse feels in the studio's page alone");
    const std::optional<DeviceKind> kind = device_kind(device_);
    if (!kind) {
      throw UsageError("--device: '" + printable(device_) +
                       "' is none of sim, replay, haply, openhaptics, dhd, 2diy, audio and gamepad");
    }
    kind_ = *kind;
    if (device_ == "replay" && replay_.empty()) throw UsageError("--device replay needs --replay");
    if (!kind_.driven && !replay_.empty()) throw UsageError("--replay: " + device_ + " is moved by a hand");
    if (mapped_ && replay_.empty()) throw UsageError("--mapped needs --replay");
    if (from_.empty() != to_.empty()) throw UsageError("--from and --to belong together");
    if (!from_.empty() && (!kind_.driven || !replay_.empty())) throw UsageError("--from: no hand is modelled");
    if (kind_.felt) settings_.servo.paced = true;
  }

  static std::optional<Eigen::Vector3d> point(const std::string& option, const std::string& text) {
    if (text.empty()) return std::nullopt;
    return point_option_m(option, text);
  }

  // Images as tiles of a plane (seed Fig. 38), by Basdogan's model unless another is asked for.
  Scene read_height_maps() {
    ReadHeightImageConfig image;
    HeightMapViewerConfig viewer;
    viewer.tile_mm = tile_.empty() ? kTile_mm : 1e3 * length_option_m("--tile", tile_);
    image.width_mm = viewer.tile_mm;
    image.range_mm = height_range_.empty() ? kHeightRange_mm : 1e3 * length_option_m("--height-range", height_range_);
    viewer.stiffness_N_per_m = settings_.render.stiffness_N_per_m;
    viewer.friction = settings_.render.friction;
    if (settings_.texture_model == TextureModelChoice::kAuto) {
      settings_.texture_model = TextureModelChoice::kNormalPerturbation;
    }
    if (from_.empty()) tile_stroke_m_ = viewer_stroke_m(height_maps_.size(), viewer);
    std::vector<Texture> tiles;
    for (const std::string& file : height_maps_) tiles.push_back(read_height_image(file, image));
    return make_height_map_viewer(tiles, viewer);
  }

  Scene read_felt_scene() {
    if (!height_maps_.empty()) return read_height_maps();
    fs::path path(scene_);
    if (fs::is_directory(path)) path /= "scene.json";
    Scene scene = read_scene(path);
    if (!mesh_unit_.empty()) {
      const double unit_m = unit_option_m("--mesh-unit", mesh_unit_);
      SceneObject& object = scene.objects.front();
      if (path.extension() == ".json" && object.unit_m != unit_m)
        throw UsageError(fmt::format("--mesh-unit: the scene says {} m", object.unit_m));
      object.unit_m = unit_m;
    }
    return scene;
  }

  // A scene within what the device can render, standing where the hand is.
  std::unique_ptr<const RenderModel> make_model(const Scene& scene, const HapticDevice& device) {
    RenderConfig config = settings_.render_config();
    if (kind_.driven) return std::make_unique<const RenderModel>(make_render_model(scene, config));
    const DeviceCaps caps =
        find_device_caps(device.info(), settings_.servo.safety, settings_.servo.rate_Hz, settings_.caps);
    CappedScene capped = cap_scene(scene, config, caps);
    warnings_.insert(warnings_.end(), capped.warnings.begin(), capped.warnings.end());
    auto model = std::make_unique<RenderModel>(make_render_model(capped.scene, capped.config));
    if (settings_.servo.frame.translation_m.isZero(0.0)) place_device(*model, device.info());
    return model;
  }

  // Puts the middle of the workspace (the device's origin where that is not known) into the middle of the scene.
  void place_device(const RenderModel& model, const DeviceInfo& info) {
    Eigen::AlignedBox3d box;
    for (const RenderObject& object : model.objects) {
      for (const Eigen::Vector3d& vertex_m : object.mesh.vertices_m) box.extend(object.T_world_mesh * vertex_m);
    }
    DeviceFrame& frame = settings_.servo.frame;
    const Eigen::Vector3d middle_m = 0.5 * (info.workspace_min_m + info.workspace_max_m);
    frame.translation_m =
        box.center() - (middle_m.allFinite() ? frame.position_m(middle_m) : Eigen::Vector3d(Eigen::Vector3d::Zero()));
  }

  // Runs the loop; throws Cancelled if it was interrupted, with zero force and no log.
  ServoResult feel(HapticDevice& device, SnapshotExchange<const RenderModel>& model, const fs::path& log,
                   const Observer& observer) {
    std::optional<FeelLog> rows;
    if (!log.empty()) rows.emplace(log, settings_.servo.timed);
    ServoConfig config = settings_.servo;
    if (kind_.driven) config.duration_s = 0.0;  // the path has it: no ramp follows
    const double whole_s = settings_.servo.duration_s;
    ServoResult servo = run_servo(device, model, config, interrupt_flag(), [&](const ServoTick& tick) {
      figures_.add(tick);
      if (rows) rows->add(tick);
      if (!config.paced && figures_.ticks() % 4096 == 0) {
        observer.update("feeling", whole_s > 0.0 ? 1e-9 * static_cast<double>(tick.t_ns) / whole_s : 0.0);
      }
    });
    if (servo.end == ServoEnd::kStopped && kind_.driven) throw Cancelled();
    if (rows) rows->commit();
    if (servo.end == ServoEnd::kFault && !log.empty()) {
      fs::path file = log;
      file.replace_extension(".flight.csv");
      refuse_stranger(file, format_flight_record({}));
      write_flight_record(file, servo.last_ticks);
      warnings_.push_back("what happened before the fault is in " + printable(file.filename().string(), 200));
    }
    return servo;
  }

  void distrust(const std::string& why) { verdict_ += (verdict_.empty() ? "" : "; ") + why; }

  void warn_of(const Problems& problems) {
    for (const Problem& problem : problems) notes_.push_back(problem.message);
  }

  Json to_json(const ServoResult& servo, const HapticDevice& device, const std::optional<RenderingScore>& score) {
    Json out;
    out["format"] = "asperity-feel";
    out["version"] = 1;
    out["scene"] = scene_.empty() ? Json(height_maps_) : Json(scene_);
    out["device"] = device_;
    out["model"] = device.info().model;
    if (!replay_.empty()) out["replay"] = replay_;
    if (!log_.empty()) out["log"] = log_;
    out["end"] = kEndNames.at(static_cast<std::size_t>(servo.end));
    out["rate_Hz"] = settings_.servo.rate_Hz;
    out["duration_s"] = static_cast<double>(figures_.ticks()) / settings_.servo.rate_Hz;
    out.update(figures_.json());
    out["limited_ticks"] = servo.statistics.limited_ticks;
    out["dissipated_J"] = servo.statistics.dissipated_J;
    if (settings_.servo.paced || settings_.servo.timed) {
      out["timing"] = timing_json(servo.statistics, settings_.servo);
    }
    if (score) out["real_against_rendered"] = score_json(*score);
    out["trustworthy"] = verdict_.empty();
    out["verdict"] = verdict_;
    out["warnings"] = warnings_;
    out["config"] = Json::parse(config_json(fields()));
    out["asperity"] = kVersion;
    return out;
  }

  void report(const ServoResult& servo, const std::optional<RenderingScore>& score) {
    std::string text = fmt::format("{:<10} {:.2f} s at {} Hz\n", device_,
                                   static_cast<double>(figures_.ticks()) / settings_.servo.rate_Hz,
                                   number_text(settings_.servo.rate_Hz));
    text += figures_.text();
    if (settings_.servo.paced || settings_.servo.timed) text += timing_text(servo.statistics, settings_.servo);
    if (score) text += score_text(*score);
    if (!log_.empty()) text += "log        " + printable(log_, 200) + "\n";
    if (!output_.empty()) text += "result in " + printable(output_, 200) + "\n";
    say(text);
    if (!quiet()) {
      for (const std::string& warning : warnings_) complain(warning);
    }
    if (!verdict_.empty()) complain("not to be trusted: " + verdict_);
  }

  std::string scene_, device_, replay_, rate_, log_, duration_, mesh_unit_, tip_, model_, stiffness_, friction_;
  std::string from_, to_, press_, speed_, output_, tile_, height_range_, height_map_list_;
  std::vector<std::string> height_maps_;
  std::optional<std::array<Eigen::Vector3d, 2>> tile_stroke_m_;
  bool mapped_ = false, timing_ = false, realtime_ = false;
  DeviceKind kind_;
  FeelSettings settings_;
  FeelFigures figures_;
  std::vector<std::string> warnings_, notes_;
  std::string verdict_;
};

}  // namespace

std::unique_ptr<Command> make_feel(CLI::App& root) { return std::make_unique<FeelCommand>(root); }

}  // namespace asperity::app
