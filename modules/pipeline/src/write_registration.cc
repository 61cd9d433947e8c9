#include "asperity/pipeline/write_registration.h"

#include <numbers>

#include "asperity/base/csv.h"
#include "asperity/base/version.h"
#include "json.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

Json undetermined_json(const RegistrationResult& registration) {
  Json out = Json::array();
  for (const UndeterminedMotion& motion : registration.undetermined) {
    out.push_back({{"description", motion.description},
                   {"sigma_m", number_or_null(motion.sigma_m)},
                   {"turn_rad", vector_json(motion.turn)},
                   {"shift_m", vector_json(motion.shift)},
                   {"centre_mesh_m", vector_json(motion.centre_mesh_m)}});
  }
  return out;
}

Json runner_up_json(const RegistrationResult& registration) {
  if (!registration.runner_up) return nullptr;
  const RunnerUp& other = *registration.runner_up;
  return {{"T_mesh_world", pose_json(other.T_mesh_world)},
          {"rms_m", other.rms_m},
          {"distance_m", other.distance_m},
          {"turn_deg", other.turn_rad * 180.0 / std::numbers::pi}};
}

Json covariance_json(const RegistrationResult& registration) {
  Json out = Json::array();
  for (int row = 0; row < 6; ++row) {
    Json line = Json::array();
    for (int column = 0; column < 6; ++column) line.push_back(number_or_null(registration.covariance(row, column)));
    out.push_back(line);
  }
  return out;
}

Json scan_json(const RegisteredScan& scan, std::size_t index) {
  Json out;
  out["name"] = scan.name;
  out["texture"] = index;
  out["length_m"] = scan.path.s_m.empty() ? 0.0 : scan.path.s_m.back() - scan.path.s_m.front();
  out["points"] = scan.path.size();
  if (scan.path_texture) {
    out["own_texture"] = {{"start_m", scan.path_texture->start_m},
                          {"length_mm", scan.path_texture->fit.texture.length_mm},
                          {"harmonics", scan.path_texture->fit.texture.a_m.size()},
                          {"bridged", scan.path_texture->bridged},
                          {"rms_height_m", scan.path_texture->fit.rms_height_m},
                          {"rms_error_m", scan.path_texture->fit.rms_error_m}};
  }
  out["base_rms_m"] = scan.process.base.base_rms_m;
  out["problems"] = problems_json(scan.process.problems);
  return out;
}

bool is_registration_file(const fs::path& file) {
  constexpr std::uint64_t kLargest_bytes = 64 << 20;
  const Json json = Json::parse(read_file(file, kLargest_bytes), nullptr, false);
  return json.is_object() && json.value("format", "") == "asperity-registration";
}

}  // namespace

std::string format_registration(const ScansOnMesh& result) {
  const RegistrationResult& registration = result.registration;
  Json out;
  out["format"] = "asperity-registration";
  out["version"] = 1;
  out["T_mesh_world"] = pose_json(registration.T_mesh_world);
  out["rms_m"] = number_or_null(registration.rms_m);
  out["mean_m"] = number_or_null(registration.mean_m);
  out["converged"] = registration.converged;
  out["stopped_by"] = kStopRuleNames.at(static_cast<std::size_t>(registration.stopped_by));
  out["iterations"] = registration.iterations;
  out["points"] = registration.points;
  out["outliers"] = registration.outliers;
  out["undetermined"] = undetermined_json(registration);
  out["runner_up"] = runner_up_json(registration);
  out["trustworthy"] = result.trustworthy;
  out["verdict"] = result.verdict.empty() ? registration.verdict : result.verdict;
  out["covariance"] = {{"of", "turn about centre_mesh_m (rad), then shift (m)"},
                       {"centre_mesh_m", vector_json(registration.centre_mesh_m)},
                       {"matrix", covariance_json(registration)}};
  out["scans"] = Json::array();
  for (std::size_t i = 0; i < result.scans.size(); ++i) out["scans"].push_back(scan_json(result.scans[i], i + 1));
  out["coordinates"] = coordinates_json(result.coordinates);
  out["problems"] = problems_json(result.problems);
  out["config"] = Json::parse(result.config_json);
  out["asperity"] = kVersion;
  // Names come from files; what is not UTF-8 in them must not stop the writing.
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

bool is_registration_folder(const fs::path& folder) noexcept {
  try {
    const fs::path file = folder / "registration.json";
    return fs::is_regular_file(file) && is_registration_file(file);
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace asperity
