#include "asperity/simulation/simulate_recording.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/error.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/geometry/read_mesh.h"
#include "asperity/json/config_json.h"
#include "asperity/simulation/carried_object.h"
#include "asperity/simulation/make_surface.h"
#include "asperity/simulation/mesh_base.h"
#include "asperity/simulation/probe_motion.h"
#include "asperity/simulation/probe_sampler.h"
#include "asperity/simulation/probe_truth.h"
#include "asperity/simulation/tracker_sampler.h"
#include "mesh_truth.h"
#include "streams.h"

namespace asperity {
namespace {

constexpr std::int64_t kStart_ns = 1'000'000'000;
constexpr std::int64_t kStepsPerUpdate = 8192;

// Throws UnlikelyMetres if the unit is not stated and metres are implausible.
TriangleMesh read_shape_mesh(const SimulatedShapeConfig& shape, const Observer& observer) {
  constexpr double kSmallestUnit_m = 1e-9;
  if (shape.mesh_file.empty()) throw Error("simulation.shape.mesh_file: the file of the mesh is missing");
  if (shape.mesh_unit_m > 0.0 && shape.mesh_unit_m < kSmallestUnit_m)
    throw Error(fmt::format("simulation.shape.mesh_unit_m: {} m is below {} m", shape.mesh_unit_m, kSmallestUnit_m));
  const MeshFile mesh = read_mesh(shape.mesh_file, {}, observer);
  if (shape.mesh_unit_m == 0.0) refuse_unlikely_metres(mesh, shape.mesh_file);
  return to_metres(mesh, shape.mesh_unit_m > 0.0 ? shape.mesh_unit_m : 1.0);
}

void check_simulation(const SimulationConfig& config) {
  // Semi-implicit Euler is stable below a phase of 2 a step; at 0.3 its frequency is right to 0.4 %.
  constexpr double kGreatestPhase = 0.3;
  const double phase = config.step_s * std::sqrt(config.contact.stiffness_N_per_m / config.hand.normal_mass_kg);
  if (phase > kGreatestPhase) {
    throw Error(fmt::format("simulation.step_s: {} s is too long for a contact of {} N/m on {} kg; at most {:.2g} s",
                            config.step_s, config.contact.stiffness_N_per_m, config.hand.normal_mass_kg,
                            config.step_s * kGreatestPhase / phase));
  }
  if (config.hand.tremor_low_Hz > config.hand.tremor_high_Hz) {
    throw Error(fmt::format("simulation.hand.tremor_low_Hz: {} is above tremor_high_Hz {}", config.hand.tremor_low_Hz,
                            config.hand.tremor_high_Hz));
  }
  if (config.hand.row_spacing_m > 0.0 && config.hand.row_spacing_m < 1e-4) {
    throw Error(
        fmt::format("simulation.hand.row_spacing_m: {} m is neither 0 nor at least 1e-4", config.hand.row_spacing_m));
  }
  // Bounds on memory and time: 20 m of path is 4 million points of relief, half an hour at 4 kHz is 7 million samples.
  constexpr double kLongestPath_m = 20.0;
  constexpr double kLongest_s = 1800.0;
  const HandConfig& hand = config.hand;
  const double strokes = hand.path == HandPathShape::kBackAndForth ? hand.strokes : 1.0;
  const double path_m = strokes * (hand.length_m + hand.row_spacing_m);
  const double duration_s =
      path_m / hand.speed_mps + 2.0 * hand.rest_s + hand.pauses * (hand.pause_s + hand.speed_ramp_s);
  if (path_m > kLongestPath_m || duration_s > kLongest_s) {
    throw Error(fmt::format("simulation.hand.length_m: a path of {:.3g} m in {:.3g} s is more than {} m or {} s",
                            path_m, duration_s, kLongestPath_m, kLongest_s));
  }
  if (!(config.probe.adc_min < config.probe.adc_max)) {
    throw Error(fmt::format("simulation.probe.adc_min: {} is not below adc_max {}", config.probe.adc_min,
                            config.probe.adc_max));
  }
  if (config.probe.true_rate_Hz * config.step_s > 1.0) {
    throw Error(fmt::format("simulation.probe.true_rate_Hz: {} is faster than one sample a step of {} s",
                            config.probe.true_rate_Hz, config.step_s));
  }
}

Json settings_json(const SimulationConfig& config) {
  SimulationConfig copy = config;
  Json out = Json::object();
  for (const ConfigField& field : list_fields("", copy)) out[field.path] = config_value_json(field.get());
  return out;
}

std::vector<Segment> segments(const Hand& hand) {
  const auto ns = [](double t_s) { return kStart_ns + std::llround(t_s * 1e9); };
  std::vector<Segment> out;
  if (hand.start_s() > 0.0) out.push_back({"rest", ns(0.0), ns(hand.start_s())});
  out.push_back({"stroke", ns(hand.start_s()), ns(hand.end_s())});
  if (hand.start_s() > 0.0) out.push_back({"rest", ns(hand.end_s()), ns(hand.duration_s())});
  return out;
}

// The object's body in the frames of the probe's tracker, with errors of its own.
TrackerSampler object_tracker(const SimulationConfig& config) {
  constexpr std::uint64_t kOtherErrors = 0x0b1ec7;
  SimulationConfig body = config;
  body.probe.tip_in_marker_m = {0.0, 0.0, 0.0};
  body.tracker.mount_Hz = 0.0;  // on the object it is glued
  return {body, kStart_ns, kOtherErrors};
}

// Where the object was at the truth's rows, and the tip as if it had not moved, or back.
void note_object(const CarriedObject& object, Truth& truth) {
  for (const std::int64_t t_ns : truth.t_ns)
    truth.T_world_object.push_back(object.T_world_body(1e-9 * static_cast<double>(t_ns - kStart_ns)));
}
std::vector<Eigen::Vector3d> tip_on_object_at_rest(const CarriedObject& object, const Truth& truth) {
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i < truth.size(); ++i)
    out.push_back(object.T_start_body() * (truth.T_world_object[i].inverse() * truth.p_world_tip_m[i]));
  return out;
}

// The stroke on `base`, or on the plane or cylinder of the config where there is none.
Recording simulate_on(const SimulationConfig& config, const Surface& surface,
                      const std::shared_ptr<const MeshBase>& base, const Observer& observer) {
  check_simulation(config);
  const auto seed = static_cast<std::uint64_t>(config.seed);
  observer.update("simulate", 0.0);

  const Calibration truth = make_probe_truth(config.probe, config.tracker, seed);
  ProbeMotion motion = base ? ProbeMotion(config, surface, base) : ProbeMotion(config, surface);
  MeshBasePath mesh_path;
  if (base) mesh_path = place_on_mesh(*base, motion.path());
  ProbeSampler probe(config, truth, kStart_ns);
  TrackerSampler tracker(config, kStart_ns);
  std::optional<CarriedObject> object;
  if (config.object.motion != SimulatedObjectMotion::kNone) object.emplace(config, motion.duration_s());
  TrackerSampler object_poses = object_tracker(config);
  const auto steps = static_cast<std::int64_t>(std::llround(motion.duration_s() / config.step_s));
  for (std::int64_t i = 0; i <= steps; ++i) {
    if (i % kStepsPerUpdate == 0) observer.update("simulate", static_cast<double>(i) / static_cast<double>(steps));
    MotionState state = motion.next();
    if (object) {
      object_poses.push(object->body_state(state.t_s));
      state = object->carry(state);
    }
    probe.push(state);
    tracker.push(state);
  }
  probe.finish();

  Recording recording;
  recording.calibration = make_stated_calibration(truth, config.probe, config.calibration, tracker.rms_position_m(),
                                                  tracker.rms_rotation_rad(), seed);
  // As `asperity calibrate tracker` states them.
  recording.calibration.tracker.slow_sigma_m = config.tracker.slow_share * tracker.rms_position_m();
  if (config.tracker.slow_share > 0.0) recording.calibration.tracker.slow_time_s = config.tracker.slow_time_s;
  recording.calibration.tip_radius_m = config.contact.tip_radius_m;
  recording.probe = std::move(probe.samples);
  recording.tracker = std::move(tracker.poses);
  if (object) note_object(*object, probe.truth);
  if (base && object) {
    std::vector<Eigen::Vector3d> moved_m = tip_on_object_at_rest(*object, probe.truth);
    moved_m.swap(probe.truth.p_world_tip_m);
    measure_on_mesh(*base, mesh_path, probe.truth);
    moved_m.swap(probe.truth.p_world_tip_m);
  } else if (base) {
    measure_on_mesh(*base, mesh_path, probe.truth);
  }
  recording.truth = std::move(probe.truth);

  RecordingInfo& info = recording.info;
  info.created = "2000-01-01T00:00:00Z";
  info.object = config.surface.kind == SurfaceKind::kFile
                    ? std::filesystem::path(config.surface.file).filename().string()
                    : std::string(kSurfaceNames[static_cast<std::size_t>(config.surface.kind)]);
  info.probe_model = std::string(kProbeModelNames[static_cast<std::size_t>(config.probe.model)]);
  info.probe_rate_Hz = config.probe.nominal_rate_Hz;
  info.adc_min = config.probe.adc_min;
  info.adc_max = config.probe.adc_max;
  info.tracker_rate_Hz = config.tracker.rate_Hz;
  Random random(seed, stream(Stream::kGravity));
  Eigen::Vector3d turn_rad;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    turn_rad[axis] = config.calibration.imperfection * config.calibration.gravity_direction_rad * random.normal();
  }
  info.gravity_world_mps2 = exp_rotation(turn_rad) * Eigen::Vector3d(config.gravity_world_mps2.data());
  info.segments = segments(motion.hand());
  if (base) info.T_mesh_world = base->T_world_mesh().inverse();
  if (object) {
    info.bodies.push_back({std::string(kObjectBody), {}});
    recording.body_poses.push_back(std::move(object_poses.poses));
    // What a registration is to find is the mesh in the frame that the scan is relative to.
    if (info.T_mesh_world) info.T_mesh_world = *info.T_mesh_world * object->T_start_body();
  }
  info.simulation.emplace().settings = settings_json(config);
  if (base) info.simulation->path_length_m = mesh_path.length_m;
  observer.update("simulate", 1.0);
  return recording;
}

}  // namespace

Recording simulate_recording(const SimulationConfig& config, const Surface& surface, const Observer& observer) {
  if (config.shape.kind == BaseShapeKind::kMesh)
    throw Error("simulation.shape.kind: a mesh is to be given with its surface");
  return simulate_on(config, surface, nullptr, observer);
}

Recording simulate_recording(const SimulationConfig& config, const Surface& surface, const TriangleMesh& mesh,
                             const Observer& observer) {
  const auto base = std::make_shared<MeshBase>(std::make_shared<MeshSurface>(mesh), config.shape, config.hand.length_m,
                                               config.hand.follow_normal);
  SimulationConfig on_mesh = config;
  on_mesh.hand.length_m = base->length_m();
  return simulate_on(on_mesh, surface, base, observer);
}

Recording simulate_recording(const SimulationConfig& config, const Observer& observer, Problems* problems) {
  const std::unique_ptr<Surface> surface =
      make_surface(config.surface,
                   static_cast<std::uint64_t>(config.surface.seed != 0 ? config.surface.seed : config.seed), problems);
  if (config.shape.kind != BaseShapeKind::kMesh) return simulate_recording(config, *surface, observer);
  return simulate_recording(config, *surface, read_shape_mesh(config.shape, observer), observer);
}

}  // namespace asperity
