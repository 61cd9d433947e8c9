#include "feel/feel_devices.h"

#include <utility>

#include <Eigen/Geometry>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/session/feel_device.h"
#include "asperity/studio/calls.h"

namespace asperity::studio {

namespace {

constexpr double kHandGoesOn_s = 600.0;
constexpr double kAbove = 0.1;  // of the scene's size: where the pointer's point begins

constexpr std::string_view kMouse = "mouse";

// The mouse is the studio's alone: its pointer comes from the browser, and no force reaches a person.
const std::vector<DeviceKind>& kinds() {
  static const std::vector<DeviceKind> all = [] {
    std::vector<DeviceKind> out{{.name = kMouse, .title = "Mouse or pen", .has_person = false}};
    out.insert(out.end(), device_kinds().begin(), device_kinds().end());
    return out;
  }();
  return all;
}

// Missing settings that are known without opening the device.
std::string missing(const DeviceKind& kind, const FeelConfig& start) {
  if (kind.name == kMouse) return "";
  const std::optional<NeededSetting> needed = start.feel.devices.missing(kind.name);
  if (!needed) return "";
  return "Its " + std::string(needed->what) + " is not set: asperity studio --set " + std::string(needed->setting) +
         "=" + std::string(needed->example) + ", for example.";
}

std::string_view words_of(const DeviceKind& kind) {
  if (kind.name == kMouse) return "The pointer pulls the point. The force is drawn, and its vibration is played.";
  if (kind.vibrotactile) return "The modelled hand moves the point; its vibration is output.";
  if (kind.mover == DeviceMover::kModelledHand) return "A modelled hand strokes the scene for ten minutes.";
  if (kind.mover == DeviceMover::kPath) return "A recording or a table of positions moves the point.";
  return "The device is opened when you start.";
}

Eigen::Vector3d above_scene_m(const RenderModel& model) {
  Eigen::AlignedBox3d box;
  for (const RenderObject& object : model.objects) {
    for (const Eigen::Vector3d& vertex_m : object.mesh.vertices_m) box.extend(object.T_world_mesh * vertex_m);
  }
  Eigen::Vector3d out_m = box.center();
  out_m.z() = box.max().z() + kAbove * box.diagonal().norm();
  return out_m;
}

FeelDrive drive_of(const FeelSetup& setup, const DeviceKind& kind, const Scene& scene, const Observer& observer) {
  if (!kind.driven()) return {};
  FeelConfig config = setup.config;
  config.feel.servo.duration_s = kHandGoesOn_s;
  FeelDrive drive;
  if (kind.mover == DeviceMover::kPath || !setup.replay.empty()) {
    if (setup.replay.empty()) {
      throw Advice("the recorded path is missing", "Choose a recording or a table of positions to replay.");
    }
    drive = read_drive(setup.replay, setup.mapped, scene, config.feel, observer);
  } else if (setup.input.tile_stroke_m) {
    drive = make_drive(scene, setup.input.tile_stroke_m->front(), setup.input.tile_stroke_m->back(), config.feel);
  } else {
    drive = make_drive(scene, std::nullopt, std::nullopt, config.feel);
  }
  check_length(drive);
  return drive;
}

}  // namespace

bool is_feel_device(std::string_view name) {
  for (const DeviceKind& kind : kinds()) {
    if (kind.name == name) return true;
  }
  return false;
}

const DeviceKind& feel_device_kind(std::string_view name) {
  for (const DeviceKind& kind : kinds()) {
    if (kind.name == name) return kind;
  }
  throw Error("unknown device '" + printable(std::string(name), 100) + "'");
}

Json feel_devices_json(const FeelConfig& start) {
  Json out = Json::array();
  for (const DeviceKind& kind : kinds()) {
    const std::string lack = missing(kind, start);
    Json each;
    each["name"] = kind.name;
    each["title"] = kind.title;
    each["available"] = lack.empty();
    each["words"] = lack.empty() ? std::string(words_of(kind)) : lack;
    each["driven"] = kind.driven();
    each["felt"] = kind.has_person;
    out.push_back(std::move(each));
  }
  return out;
}

OpenedFeel open_feel(const FeelSetup& setup, const Scene& scene, const Observer& observer) {
  OpenedFeel out;
  out.kind = feel_device_kind(setup.device);
  const std::string lack = missing(out.kind, setup.config);
  if (!lack.empty()) throw Advice(std::string(out.kind.title) + " cannot be opened", lack);
  out.config = setup.config;
  out.config.feel.servo.paced = true;
  out.config.feel.servo.duration_s = 0.0;
  out.config.pointer.rate_Hz = out.config.feel.servo.rate_Hz;
  observer.update("the path", 0.0);
  out.drive = drive_of(setup, out.kind, scene, observer);
  const bool mouse = out.kind.name == kMouse;
  observer.update("the device", 0.3);
  std::string device_told;  // of a device that continues
  if (!mouse) {
    out.device = open_device(setup.device, out.drive, out.config.feel);
    out.info = out.device->info();
    device_told = out.device->fault();
  }
  observer.update("the scene", 0.6);
  // Nobody's motors are at the pointer's end: the scene is left as it is.
  PreparedModel prepared = prepare_render_model(scene, out.info, mouse || out.kind.driven(), out.config.feel);
  if (mouse) {
    const Eigen::Vector3d start_m = above_scene_m(*prepared.model);
    out.targets = std::make_shared<PointerTargets>(start_m);
    // The pointer is in the scene's world already.
    out.config.feel.servo.frame = DeviceFrame();
    out.device = open_pointer(out.config.pointer, start_m, out.targets);
    out.info = out.device->info();
  }
  if (out.kind.driven()) out.config.feel.servo.frame = DeviceFrame();
  out.model = std::move(prepared.model);
  out.warnings = std::move(prepared.warnings);
  if (!device_told.empty()) out.warnings.push_back(setup.device + ": " + device_told);
  for (const Problem& problem : out.drive.problems) out.warnings.push_back(problem.message);
  return out;
}

}  // namespace asperity::studio
