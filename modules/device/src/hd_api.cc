#include "hd_api.h"

#include <fmt/format.h>

#include "driver_library.h"

namespace asperity::hd {

Api load_api(const std::string& library) {
  Api api{};
  load_driver(
      "openhaptics", {library.empty() ? "libHD.so" : library},
      {driver_symbol("hdInitDevice", api.init_device), driver_symbol("hdDisableDevice", api.disable_device),
       driver_symbol("hdBeginFrame", api.begin_frame), driver_symbol("hdEndFrame", api.end_frame),
       driver_symbol("hdGetError", api.get_error), driver_symbol("hdEnable", api.enable),
       driver_symbol("hdDisable", api.disable), driver_symbol("hdGetDoublev", api.get_doubles),
       driver_symbol("hdSetDoublev", api.set_doubles), driver_symbol("hdGetIntegerv", api.get_integers),
       driver_symbol("hdScheduleAsynchronous", api.schedule_asynchronous),
       driver_symbol("hdStartScheduler", api.start_scheduler), driver_symbol("hdStopScheduler", api.stop_scheduler),
       driver_symbol("hdUnschedule", api.unschedule), driver_symbol("hdSetSchedulerRate", api.set_scheduler_rate),
       driver_symbol("hdGetString", api.get_string, false)});
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
