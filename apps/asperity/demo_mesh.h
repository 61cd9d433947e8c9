#pragma once

#include <filesystem>
#include <string>

#include "asperity/base/progress.h"
#include "asperity/json/json.h"
#include "asperity/pipeline/process_config.h"
#include "asperity/texture/texture.h"

namespace asperity::app {

struct MeshDemo {
  std::string text;  // the table's rows
  Json json;
  bool trustworthy = true;
  std::string verdict;  // in words, if not
};

// The second half of the demonstration: a pebble (make_pebble.h), written as pebble.obj in millimetres; a scan of
// sandpaper over it in a random pose; the scan registered from a guess 5 mm and 5 degrees off and compared with the
// truth; and `other` painted beside it. In `folder`: pebble.obj, recordings/pebble, results/pebble, painted.
MeshDemo demonstrate_mesh(const std::filesystem::path& folder, const ProcessConfig& process, const Texture& other,
                          const Observer& observer);

}  // namespace asperity::app
