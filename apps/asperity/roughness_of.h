#pragma once

#include <string>

#include "asperity/json/json.h"
#include "asperity/plot/figure.h"
#include "roughness_settings.h"

namespace asperity::app {

// What `roughness` finds of one file: its JSON object, what a person reads, and its plots, if these are wanted.
struct RoughnessFound {
  std::string file;
  Json json;
  std::string text;
  Figure figure;
};

// Of heights in any file that read_heights() knows, a result's folder (its profile.csv), an areal *.texture.json, a
// stroke's folder, or "-", standard input. `config` is what JSON states as the settings. Throws Error as the readers
// and measures do, and UsageError where a setting is of another kind of file.
RoughnessFound measure_file(const std::string& file, const RoughnessSettings& settings, const Json& config,
                            bool with_figure);

}  // namespace asperity::app
