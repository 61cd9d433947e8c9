#include "write_target.h"

#include "asperity/base/text.h"

namespace asperity::studio {

std::filesystem::path write_target(const Project& project, const Request& request) {
  const std::string name = request.text("name");
  std::filesystem::path target = project.writable(name);
  const bool replace = request.has("replace") && request.flag("replace");
  std::error_code error;
  if (!replace && std::filesystem::exists(std::filesystem::symlink_status(target, error))) {
    throw Advice(printable(name, 200) + ": is there already",
                 "Choose another name, such as " + project.free_name(name) + ", or say that it is to be replaced.");
  }
  return target;
}

}  // namespace asperity::studio
