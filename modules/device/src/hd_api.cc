#include "hd_api.h"

#include <fmt/format.h>

#include "asperity/base/load_library.h"

namespace asperity::hd {

Api load_api(const std::string& library) {
  Api api{};
  load_library(
      "openhaptics: its driver", {library.empty() ? "libHD.so" : library},
      {library_symbol("hdInitDevice", api.init_device), library_symbol("hdDisableDevice", api.disable_device),
       library_symbol("hdBeginFrame", api.begin_frame), library_symbol("hdEndFrame", api.end_frame),
       library_symbol("hdGetError", api.get_error), library_symbol("hdEnable", api.enable),
       library_symbol("hdDisable", api.disable), library_symbol("hdGetDoublev", api.get_doubles),
       library_symbol("hdSetDoublev", api.set_doubles), library_symbol("hdGetIntegerv", api.get_integers),
       library_symbol("hdScheduleAsynchronous", api.schedule_asynchronous),
       library_symbol("hdStartScheduler", api.start_scheduler), library_symbol("hdStopScheduler", api.stop_scheduler),
       library_symbol("hdUnschedule", api.unschedule), library_symbol("hdSetSchedulerRate", api.set_scheduler_rate),
       library_symbol("hdGetString", api.get_string, false)});
  return api;
}

std::string error_text(unsigned code) {
  const char* words = "the driver reports an error";
  if (code == kWarmMotors) words = "the motors are warm";
  if (code == kExceededMaxForce) words = "the force was beyond the device's limit";
  if (code == kExceededMaxVelocity) words = "the velocity was beyond the device's limit";
  if (code == kCommError) words = "the connection to the device is lost";
  if (code == kFrameError) words = "a haptic frame was out of order";
  return fmt::format("{} (0x{:03x})", words, code);
}

}  // namespace asperity::hd
