#include "asperity/import/stated_setting.h"

#include <algorithm>

namespace asperity {

std::string as_option(const StatedSetting& setting) {
  if (setting.path == "mapping.pose.rate_Hz") return "--pose-file-rate " + setting.value;  // --pose-rate thins
  std::string name = setting.path.substr(setting.path.find('.') + 1);
  if (const auto rate = name.find(".rate_Hz"); rate != std::string::npos)
    name.replace(rate, std::string::npos, "-rate");
  std::replace(name.begin(), name.end(), '_', '-');
  if (setting.value == "true") return "--" + name;
  return setting.value == "false" ? "no --" + name : "--" + name + " " + setting.value;
}

}  // namespace asperity
