#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/base/output.h"
#include "asperity/device/servo_tick.h"

namespace asperity {

inline constexpr const char* kFeelLogColumns =
    "t_ns,px_m,py_m,pz_m,proxy_x_m,proxy_y_m,proxy_z_m,fx_N,fy_N,fz_N,contact_N,texture_N,friction_N,texture_height_m,"
    "out_x_N,out_y_N,out_z_N";

// One row of the log, without its end: place of the device, proxy and rendered force in the scene's world, the
// magnitudes of its three parts, the texture's height, and the force that the safety layer let through. The
// texture's part is negative where it pulls into the object.
void append_feel_row(std::string& out, const ServoTick& tick);

// The log of a run, written as a whole by rename: without commit() nothing remains.
class FeelLog {
 public:
  // With `timing` a last column step_ns. Throws Error if the file cannot be written, or exists and is not such a log.
  FeelLog(const std::filesystem::path& file, bool timing);
  void add(const ServoTick& tick);
  void commit();

 private:
  OutputFile file_;
  std::string rows_;
  bool timing_;
};

}  // namespace asperity
