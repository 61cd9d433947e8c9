#include "asperity/base/folder_content.h"

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace fs = std::filesystem;

FolderContent FolderContent::with_added(const fs::path& file) {
  FolderContent out(false);
  out.added = file;
  return out;
}

std::function<bool(const fs::path&)> naming_added(FolderContent (*is_ours)(const fs::path&)) {
  return [is_ours](const fs::path& folder) {
    const FolderContent content = is_ours(folder);
    if (!content && !content.added.empty()) {
      throw Error(printable(folder.string(), 200) + ": the file " + printable(content.added.string(), 200) +
                  " was not written by asperity; nothing was changed. Move this file elsewhere, or choose another "
                  "output folder");
    }
    return content.ours;
  };
}

}  // namespace asperity
