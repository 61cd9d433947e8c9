#include "asperity/device/write_flight_record.h"

#include <array>
#include <cstdint>
#include <string_view>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/device/safety_cause.h"

namespace asperity {
namespace {

constexpr std::string_view kHeader =
    "t_ns,status,sequence,buttons,device_x_m,device_y_m,device_z_m,device_vx_mps,device_vy_mps,device_vz_mps,"
    "px_m,py_m,pz_m,proxy_x_m,proxy_y_m,proxy_z_m,fx_N,fy_N,fz_N,contact_x_N,contact_y_N,contact_z_N,"
    "texture_x_N,texture_y_N,texture_z_N,friction_x_N,friction_y_N,friction_z_N,texture_height_m,sticking,"
    "starts_inside,object,triangle,out_x_N,out_y_N,out_z_N,limited_by,late_ns,step_ns\n";

constexpr std::array<std::string_view, 4> kStatusNames{"ready", "stalled", "fault", "ended"};

void append_field(std::string& out, std::int64_t value) {
  append_number(out, value);
  out += ',';
}

void append_field(std::string& out, double value) {
  append_number(out, value);
  out += ',';
}

void append_field(std::string& out, const Eigen::Vector3d& value) {
  for (const double x : value) append_field(out, x);
}

}  // namespace

std::string format_flight_record(std::span<const ServoTick> ticks) {
  std::string out(kHeader);
  for (const ServoTick& t : ticks) {
    append_field(out, t.t_ns);
    out += kStatusNames[static_cast<std::size_t>(t.reading.status)];
    out += ',' + std::to_string(t.reading.sequence) + ',' + std::to_string(t.reading.buttons) + ',';
    append_field(out, t.reading.p_m);
    append_field(out, t.reading.v_mps);
    append_field(out, t.p_world_m);
    append_field(out, t.output.proxy_m);
    append_field(out, t.output.force_N);
    append_field(out, t.output.contact_N);
    append_field(out, t.output.texture_N);
    append_field(out, t.output.friction_N);
    append_field(out, t.output.texture_height_m);
    append_field(out, std::int64_t{t.output.sticking});
    append_field(out, std::int64_t{t.output.starts_inside});
    // No object and no triangle are empty cells.
    if (t.output.contact.found()) out += std::to_string(t.output.contact.object);
    out += ',';
    if (t.output.contact.found()) out += std::to_string(t.output.contact.triangle);
    out += ',';
    append_field(out, t.out_world_N);
    out += cause_names(t.limited_by) + ',';
    append_field(out, t.late_ns);
    append_number(out, t.step_ns);
    out += '\n';
  }
  return out;
}

void write_flight_record(const std::filesystem::path& path, std::span<const ServoTick> ticks) {
  write_file(path, format_flight_record(ticks));
}

}  // namespace asperity
