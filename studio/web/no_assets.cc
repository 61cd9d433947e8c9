#include "asperity/web/assets.h"

// The program was built without the app.
namespace asperity::web {

bool built() { return false; }
std::optional<Asset> find_asset(std::string_view) { return std::nullopt; }
std::string_view report_script() { return {}; }
std::string_view report_style() { return {}; }

}  // namespace asperity::web
