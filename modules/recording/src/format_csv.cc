#include "asperity/recording/format_recording.h"
#include "csv_line.h"

namespace asperity {

std::string probe_header(bool has_gyro, bool has_force3) {
  std::string out = "t_ns,accel_i,accel_j,accel_k,force";
  if (has_gyro) out += ",gyro_i,gyro_j,gyro_k";
  if (has_force3) out += ",force_x,force_y,force_z";
  return out + "\n";
}

namespace {
bool has_sigmas(const TrackerStream& tracker) {
  return !tracker.sigma_position_m.empty() && !tracker.sigma_rotation_rad.empty();
}
bool has_noise(const TrackerStream& tracker) {
  return !tracker.noise_position_m.empty() && !tracker.noise_rotation_rad.empty();
}
}  // namespace

std::string tracker_header(bool with_markers, bool with_reprojection, bool with_sigmas, bool with_noise) {
  std::string out = "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz";
  if (with_markers) out += ",markers";
  if (with_reprojection) out += ",reprojection_px";
  if (with_sigmas) out += ",sigma_px_m,sigma_py_m,sigma_pz_m,sigma_rx_rad,sigma_ry_rad,sigma_rz_rad";
  if (with_noise) out += ",noise_px_m,noise_py_m,noise_pz_m,noise_rx_rad,noise_ry_rad,noise_rz_rad";
  return out + "\n";
}

void append_probe_rows(std::string& out, const ProbeStream& probe, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    append_time(out, probe.t_ns[i]);
    append_cells(out, probe.accel_counts[i]);
    append_cell(out, probe.force_counts[i]);
    if (!probe.gyro_counts.empty()) append_cells(out, probe.gyro_counts[i]);
    if (!probe.force3_counts.empty()) append_cells(out, probe.force3_counts[i]);
    out += '\n';
  }
}

void append_tracker_rows(std::string& out, const TrackerStream& tracker, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    append_time(out, tracker.t_ns[i]);
    append_cells(out, tracker.T_world_marker[i].translation_m);
    append_cells(out, tracker.T_world_marker[i].rotation);
    if (!tracker.markers.empty()) {
      out += ',';
      append_number(out, std::int64_t{tracker.markers[i]});
    }
    if (!tracker.reprojection_px.empty()) append_cell(out, tracker.reprojection_px[i]);
    if (has_sigmas(tracker)) {
      append_cells(out, tracker.sigma_position_m[i]);
      append_cells(out, tracker.sigma_rotation_rad[i]);
    }
    if (has_noise(tracker)) {
      append_cells(out, tracker.noise_position_m[i]);
      append_cells(out, tracker.noise_rotation_rad[i]);
    }
    out += '\n';
  }
}

std::string format_probe_csv(const ProbeStream& probe) {
  std::string out = probe_header(!probe.gyro_counts.empty(), !probe.force3_counts.empty());
  append_probe_rows(out, probe, 0, probe.size());
  return out;
}

std::string format_tracker_csv(const TrackerStream& tracker) {
  std::string out = tracker_header(!tracker.markers.empty(), !tracker.reprojection_px.empty(), has_sigmas(tracker),
                                   has_noise(tracker));
  append_tracker_rows(out, tracker, 0, tracker.size());
  return out;
}

std::string format_truth_csv(const Truth& truth) {
  const bool has_object = !truth.T_world_object.empty();
  std::string out = "t_ns,s_m,height_m,px_m,py_m,pz_m,qw,qx,qy,qz,force_N";
  if (has_object) out += ",object_px_m,object_py_m,object_pz_m,object_qw,object_qx,object_qy,object_qz";
  out += '\n';
  const auto cell_or_nan = [&](double value) {
    out += ',';
    append_exact(out, value);
  };
  for (std::size_t i = 0; i < truth.size(); ++i) {
    append_time(out, truth.t_ns[i]);
    cell_or_nan(truth.s_m[i]);
    cell_or_nan(truth.height_m[i]);
    append_cells(out, truth.p_world_tip_m[i]);
    append_cells(out, truth.q_world_marker[i]);
    cell_or_nan(truth.force_N[i]);
    if (has_object) {
      append_cells(out, truth.T_world_object[i].translation_m);
      append_cells(out, truth.T_world_object[i].rotation);
    }
    out += '\n';
  }
  return out;
}

}  // namespace asperity
