#include "dhd_api.h"

#include <cstdlib>
#include <vector>

#include "asperity/base/load_library.h"

namespace asperity::dhd {

namespace {

std::vector<std::string> candidates(const std::string& library) {
  if (!library.empty()) return {library};
  const std::vector<std::string> names = {"libdrd.so.3", "libdrd.so", "libdhd.so.3", "libdhd.so"};
  std::vector<std::string> out = names;
  const char* const sdk = std::getenv("FDSDK");
  if (sdk != nullptr && *sdk != '\0') {
    for (const std::string& name : names) out.push_back(std::string(sdk) + "/lib/release/lin-x86_64-gcc/" + name);
  }
  return out;
}

}  // namespace

Api load_api(const std::string& library) {
  Api api{};
  load_library(
      "dhd: its driver", candidates(library),
      {library_symbol("dhdOpen", api.open), library_symbol("dhdClose", api.close),
       library_symbol("dhdEnableForce", api.enable_force), library_symbol("dhdGetPosition", api.get_position),
       library_symbol("dhdGetLinearVelocity", api.get_linear_velocity), library_symbol("dhdSetForce", api.set_force),
       library_symbol("dhdGetButtonMask", api.get_button_mask), library_symbol("dhdErrorGetLastStr", api.last_error),
       library_symbol("dhdGetSystemName", api.system_name, false),
       library_symbol("dhdEnableExpertMode", api.enable_expert_mode, false),
       library_symbol("dhdDisableExpertMode", api.disable_expert_mode, false),
       library_symbol("dhdSetWatchdog", api.set_watchdog, false),
       library_symbol("dhdGetWatchdog", api.get_watchdog, false)});
  return api;
}

}  // namespace asperity::dhd
