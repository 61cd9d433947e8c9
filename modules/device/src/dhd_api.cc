#include "dhd_api.h"

#include <cstdlib>
#include <vector>

#include "driver_library.h"

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
  load_driver(
      "dhd", candidates(library),
      {driver_symbol("dhdOpen", api.open), driver_symbol("dhdClose", api.close),
       driver_symbol("dhdEnableForce", api.enable_force), driver_symbol("dhdGetPosition", api.get_position),
       driver_symbol("dhdGetLinearVelocity", api.get_linear_velocity), driver_symbol("dhdSetForce", api.set_force),
       driver_symbol("dhdGetButtonMask", api.get_button_mask), driver_symbol("dhdErrorGetLastStr", api.last_error),
       driver_symbol("dhdGetSystemName", api.system_name, false)});
  return api;
}

}  // namespace asperity::dhd
