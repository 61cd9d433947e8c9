#include "marker_family.h"

#include <memory>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/tracking/aruco_dictionary.h"
#include "asperity/tracking/detect_tags.h"

namespace asperity::app {

namespace fs = std::filesystem;

TagFamily open_family(const std::string& name) {
  const std::shared_ptr<TagDetector> detector = make_tag_detector(name);
  return {name, [detector](int id) { return detector->pattern(id); }};
}

std::string family_beside(const std::string& family, const fs::path& folder) {
  const std::string file = aruco_file(family);
  if (file.empty()) return family;
  const fs::path inner =
      fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder.empty() ? "." : folder));
  if (inner.empty() || *inner.begin() == "..") {
    throw Error("--markers: the dictionary " + printable(file, 200) +
                " does not lie beside the body's file: put it there");
  }
  return "aruco:" + inner.generic_string();
}

}  // namespace asperity::app
