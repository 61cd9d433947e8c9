#include "write_target.h"

#include <algorithm>

#include "asperity/base/text.h"

namespace asperity::studio {

std::filesystem::path write_target(const Project& project, const Request& request) {
  const std::string name = request.text("name");
  std::filesystem::path target = project.writable(name);
  const bool replace = request.has("replace") && request.flag("replace");
  if (!replace && is_taken(target)) {
    const std::size_t ending = std::min(name.find('.', 1), name.size());
    throw Advice(printable(name, 200) + ": exists already",
                 "Choose another name, such as " + project.free_name(name.substr(0, ending), name.substr(ending)) +
                     ", or choose to replace it.");
  }
  return target;
}

void put_in_place(OutputFolder& folder, const std::string& name, Hub& hub) {
  for (const std::filesystem::path& kept : folder.commit()) {
    const std::string file = printable(name, 200) + "/" + printable(kept.string(), 200);
    hub.broadcast("note", Json{{"message", file + " was added there in the meantime; it was kept"}, {"hint", ""}});
  }
}

}  // namespace asperity::studio
