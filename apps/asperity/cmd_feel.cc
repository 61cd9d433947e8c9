#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/folder_content.h"
#include "asperity/base/length_unit_names.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/device/device_registry.h"
#include "asperity/device/servo_loop.h"
#include "asperity/device/write_flight_record.h"
#include "asperity/fidelity/check_renderer.h"
#include "asperity/json/config_json.h"
#include "asperity/scene/set_mesh_unit.h"
#include "asperity/session/feel_device.h"
#include "asperity/session/feel_drive.h"
#include "asperity/session/feel_log.h"
#include "asperity/session/feel_report.h"
#include "asperity/session/feel_scene.h"
#include "asperity/session/feel_settings.h"
#include "asperity/session/interrupt.h"
#include "asperity/session/our_file.h"
#include "asperity/session/our_folder.h"
#include "asperity/session/run_evidence.h"
#include "asperity/verdict/verdict_json.h"
#include "commands.h"
#include "option_units.h"
#include "scene_options.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;
constexpr std::array<const char*, 4> kEndNames{"duration", "device_ended", "stopped", "fault"};

std::vector<std::string_view> device_names() {
  std::vector<std::string_view> out;
  for (const DeviceKind& kind : device_kinds()) out.push_back(kind.name);
  return out;
}

// "sim (the default), replay or haply": all devices, with remarks on some.
std::string device_list(std::string_view last, const std::map<std::string_view, std::string_view>& remarks) {
  std::string out;
  const std::span<const DeviceKind> kinds = device_kinds();
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (k > 0) out += k + 1 < kinds.size() ? ", " : fmt::format(" {} ", last);
    out += kinds[k].name;
    if (remarks.contains(kinds[k].name)) out += fmt::format(" ({})", remarks.at(kinds[k].name));
  }
  return out;
}

class FeelCommand : public Command {
 public:
  explicit FeelCommand(Parser& root)
      : Command(root, "feel", "Render a scene with a haptic device, or log the forces of a modelled hand") {
    parser().add_option("SCENE", options_.scene, "A scene.json, a folder that has one, or a mesh without textures");
    parser()
        .add_option("--height-maps", options_.height_maps,
                    "Replaces SCENE: images side by side on a plane, a.png,b.png,…")
        ->type_name("FILES");
    parser().add_option("--tile", options_.tile, "Side of a height map's tile; default: 10mm")->type_name("LENGTH");
    parser()
        .add_option("--height-range", options_.height_range, "Height from black to white; default: 2.5mm")
        ->type_name("LENGTH");
    parser()
        .add_option(
            "--device", device_,
            device_list("or", {{"sim", "the default: a modelled hand"}, {"replay", "the default with --replay"}}))
        ->type_name("NAME")
        ->suggest(device_names());
    parser()
        .add_option("--replay", replay_,
                    "trajectory.csv with the positions of the device point in the scene's world; or a recording, "
                    "repeated where the scene has it registered")
        ->type_name("FILE|REC");
    parser().add_flag("--mapped", mapped_, "The positions of --replay are in the tracker's world");
    parser().add_option("--rate", rate_, "Rate of the servo, Hz; default: 1000")->type_name("HZ");
    parser().add_option("--log", log_, "Write one row per tick")->type_name("FILE.csv");
    parser()
        .add_option("--duration", duration_, "Stop after this time; else at the path's end, or until interrupted")
        ->type_name("TIME");
    parser().add_flag("--timing", timing_, "Time each step: a column step_ns in the log");
    parser().add_flag("--realtime", realtime_, "Run in real time also without a hand (sim, replay)");
    parser()
        .add_option("--mesh-unit", options_.mesh_unit,
                    "Unit of a mesh given without a scene: m (the default), mm, or a length such as 0.06m")
        ->type_name("LENGTH")
        ->suggest(length_unit_names());
    parser().add_option("--tip", tip_, "Radius of the tip; default: a point")->type_name("LENGTH");
    parser()
        .add_option("--texture-model", model_,
                    "height, normal-perturbation, lateral-gradient, stochastic, autoregressive or decaying-sinusoids, "
                    "for all textures; auto: each its own")
        ->type_name("NAME")
        ->suggest(kTextureForceModelNames);
    parser()
        .add_option("--stiffness", stiffness_, "Stiffness where the scene states none, N/m; default: 1000")
        ->type_name("K");
    parser()
        .add_option("--friction", friction_, "Coefficient where the scene states none; default: 0")
        ->type_name("MU");
    parser().add_option("--from", from_, "sim: where the stroke begins, x,y,z in m or with units")->type_name("POINT");
    parser()
        .add_option("--to", to_, "sim: where the stroke reverses; without both, it is along the texture")
        ->type_name("POINT");
    parser().add_option("--press", press_, "sim: force of the hand; default: 1N")->type_name("FORCE");
    parser().add_option("--speed", speed_, "sim: speed of the stroke; default: 50mm/s")->type_name("SPEED");
    parser()
        .add_option("-o,--output", output_, "Folder of result.json, and of the log unless --log names its file")
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
    input_ = scene_input_of(options_);
    if (parser().count("--log") > 0 && (log_.empty() || log_ == "-"))
      throw UsageError("--log needs the name of a file");
    std::vector<std::string> inputs = input_.height_maps;
    inputs.insert(inputs.end(), {input_.scene, replay_});
    if (!log_.empty()) refuse_stranger(log_, kFeelLogColumns, inputs);
    choose_device();
    std::optional<OutputFolder> folder;
    if (!output_.empty()) folder.emplace(output_, naming_added(is_our_folder));
    observer.update("reading", 0.0);
    reads(replay_.empty() ? input_.scene : replay_);
    const Scene scene = read_scene(observer);
    FeelDrive drive;
    if (!replay_.empty()) {
      drive = read_drive(replay_, mapped_, scene, settings_, observer);
    } else if (kind_.driven() && from_.empty() && input_.tile_stroke_m) {
      drive = make_drive(scene, input_.tile_stroke_m->front(), input_.tile_stroke_m->back(), settings_);
    } else if (kind_.driven()) {
      drive = make_drive(scene, point("--from", from_), point("--to", to_), settings_);
    }
    if (settings_.servo.duration_s > 0.0) cut_drive(drive, settings_.servo.duration_s, settings_.servo.rate_Hz);
    check_length(drive);
    reads("");
    warn_of(scene.problems);
    warn_of(drive.problems);
    const std::unique_ptr<HapticDevice> device = open_device(device_, drive, settings_);
    observer.update("scene", 0.0);
    PreparedModel prepared = prepare_render_model(scene, device->info(), kind_.driven(), settings_);
    warnings_ = prepared.warnings;
    if (const std::string told = device->fault(); !told.empty()) warnings_.push_back(device_ + ": " + told);
    SnapshotExchange<const RenderModel> model(std::move(prepared.model));
    const fs::path log = !log_.empty() ? fs::path(log_) : folder ? folder->path() / "log.csv" : fs::path();
    const ServoResult servo = feel(*device, model, log, observer);
    verdicts_ = judge_run(run_evidence(statistics_, servo, *device, drive, *model.acquire(), settings_.servo.safety));
    warnings_.insert(warnings_.end(), notes_.begin(), notes_.end());
    std::optional<RendererCheck> check;
    const bool whole = device_ != "sim" && !(settings_.servo.duration_s > 0.0) && servo.end == ServoEnd::kDeviceEnded;
    if (drive.scan && !whole) warnings_.push_back("the renderer is checked over a whole replay only");
    if (drive.scan && whole) {
      check = check_renderer(drive.scan->measured, drive.scan->pressed, *model.acquire(), settings_.servo.rate_Hz,
                             settings_.renderer_check, observer);
      verdicts_.insert(verdicts_.end(), check->verdicts.begin(), check->verdicts.end());
      sort_verdicts(verdicts_);
    }
    const std::string json = to_json(servo, *device, check).dump_repaired(2);
    if (folder) {
      write_file(folder->path() / "result.json", json + "\n");
      write_listing(folder->path());
      folder->commit();
    }
    print_json(json);
    report(servo, check);
    if (servo.end == ServoEnd::kStopped) return interrupt_exit_code();
    return is_trustworthy(verdicts_) ? kDone : kNotTrustworthy;
  }

 private:
  Scene read_scene(const Observer& observer) {
    try {
      return read_scene_input(input_, settings_, observer);
    } catch (const WrongUnit& error) {
      throw UsageError(std::string("--mesh-unit: ") + error.what());
    }
  }

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

  void choose_device() {
    if (device_.empty()) device_ = replay_.empty() ? "sim" : "replay";
    if (device_ == "mouse")
      throw UsageError("--device mouse: the mouse is a device of the studio's page only; run asperity studio");
    const DeviceKind* kind = find_device_kind(device_);
    if (!kind) throw UsageError("--device: '" + printable(device_) + "' is none of " + device_list("and", {}));
    kind_ = *kind;
    if (const auto needed = settings_.devices.missing(device_)) {
      throw UsageError(fmt::format("--device {}: its {} is missing, --set {}={} or such", device_, needed->what,
                                   needed->setting, needed->example));
    }
    if (kind_.mover == DeviceMover::kPath && replay_.empty())
      throw UsageError("--device " + device_ + " needs --replay");
    if (!kind_.driven() && !replay_.empty()) throw UsageError("--replay: " + device_ + " is moved by a hand");
    if (mapped_ && replay_.empty()) throw UsageError("--mapped needs --replay");
    if (from_.empty() != to_.empty()) throw UsageError("--from and --to need each other");
    if (!from_.empty() && (!kind_.driven() || !replay_.empty()))
      throw UsageError("--from: only the device sim has a modelled hand");
    if (kind_.has_person) settings_.servo.paced = true;
  }

  static std::optional<Eigen::Vector3d> point(const std::string& option, const std::string& text) {
    if (text.empty()) return std::nullopt;
    return point_option_m(option, text);
  }

  // Runs the loop; throws Cancelled if it was interrupted, with zero force and no log.
  ServoResult feel(HapticDevice& device, SnapshotExchange<const RenderModel>& model, const fs::path& log,
                   const Observer& observer) {
    std::optional<FeelLog> rows;
    if (!log.empty()) rows.emplace(log, settings_.servo.timed);
    ServoConfig config = settings_.servo;
    if (kind_.driven()) config.duration_s = 0.0;  // the path has it: no ramp follows
    const double whole_s = settings_.servo.duration_s;
    std::optional<ForceHold> hold;
    if (kind_.has_person) hold.emplace();
    ServoResult servo = run_servo(device, model, config, interrupt_flag(), [&](const ServoTick& tick) {
      statistics_.add(tick);
      if (rows) rows->add(tick);
      if (!config.paced && statistics_.ticks() % 4096 == 0) {
        observer.update("feeling", whole_s > 0.0 ? 1e-9 * static_cast<double>(tick.t_ns) / whole_s : 0.0);
      }
    });
    device.close();  // before anything that takes time
    hold.reset();
    if (servo.end == ServoEnd::kStopped && kind_.driven()) throw Cancelled();
    if (rows) rows->commit();
    if (servo.end == ServoEnd::kFault) keep_flight_record(log, servo);
    return servo;
  }

  // The time before a fault: beside the log, or in the current folder.
  void keep_flight_record(const fs::path& log, const ServoResult& servo) {
    fs::path file = log.empty() ? fs::path("asperity-feel.csv") : log;
    file.replace_extension(".flight.csv");
    try {
      refuse_stranger(file, format_flight_record({}));
      write_flight_record(file, servo.last_ticks);
      warnings_.push_back("the ticks before the fault are in " + printable(file.filename().string(), 200));
    } catch (const Error& error) {
      warnings_.push_back(std::string("no flight record: ") + error.what());
    }
  }

  void warn_of(const Problems& problems) {
    for (const Problem& problem : problems) notes_.push_back(problem.message);
  }

  Json to_json(const ServoResult& servo, const HapticDevice& device, const std::optional<RendererCheck>& check) {
    Json out;
    out["format"] = "asperity-feel";
    out["version"] = 1;
    out["scene"] = input_.scene.empty() ? Json(input_.height_maps) : Json(input_.scene);
    out["device"] = device_;
    out["model"] = device.info().model;
    if (!replay_.empty()) out["replay"] = replay_;
    if (!log_.empty()) out["log"] = log_;
    out["end"] = kEndNames.at(static_cast<std::size_t>(servo.end));
    out["rate_Hz"] = settings_.servo.rate_Hz;
    out["duration_s"] = static_cast<double>(statistics_.ticks()) / settings_.servo.rate_Hz;
    out.update(statistics_.json());
    out["limited_ticks"] = servo.statistics.limited_ticks;
    out["dissipated_J"] = servo.statistics.dissipated_J;
    if (settings_.servo.paced || settings_.servo.timed) {
      out["timing"] = timing_json(servo.statistics, settings_.servo);
    }
    if (check) out["renderer_check"] = renderer_check_json(*check);
    out["trustworthy"] = is_trustworthy(verdicts_);
    out["verdict"] = verdict_sentence(verdicts_);
    out["verdicts"] = verdicts_json(verdicts_);
    out["warnings"] = warnings_;
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    return out;
  }

  void report(const ServoResult& servo, const std::optional<RendererCheck>& check) {
    std::string text = fmt::format("{:<10} {:.2f} s at {} Hz\n", device_,
                                   static_cast<double>(statistics_.ticks()) / settings_.servo.rate_Hz,
                                   number_text(settings_.servo.rate_Hz));
    text += statistics_.text();
    if (settings_.servo.paced || settings_.servo.timed) text += timing_text(servo.statistics, settings_.servo);
    if (check) text += renderer_check_text(*check);
    if (!log_.empty()) text += "log        " + printable(log_, 200) + "\n";
    if (!output_.empty()) text += "result in " + printable(output_, 200) + "\n";
    say(text);
    if (!quiet()) {
      for (const std::string& warning : warnings_) print_error(warning);
    }
    for (const Verdict& verdict : verdicts_) {
      if (verdict.severity == Severity::kInvalid || !quiet()) print_error(verdict_line(verdict));
    }
  }

  std::string device_, replay_, rate_, log_, duration_, tip_, model_, stiffness_, friction_;
  std::string from_, to_, press_, speed_, output_;
  bool mapped_ = false, timing_ = false, realtime_ = false;
  SceneOptions options_;
  SceneInput input_;
  DeviceKind kind_;
  FeelSettings settings_;
  FeelStatistics statistics_;
  std::vector<std::string> warnings_, notes_;
  Verdicts verdicts_;
};

}  // namespace

std::unique_ptr<Command> make_feel(Parser& root) { return std::make_unique<FeelCommand>(root); }

}  // namespace asperity::app
