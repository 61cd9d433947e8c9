#pragma once

#include <map>
#include <string>
#include <vector>

#include "asperity/profile/read_heights.h"
#include "asperity/texture/fit_areal.h"
#include "asperity/texture/texture.h"

namespace asperity {

// True for a name that ends in .json: a texture file. Everything else is read as heights.
bool is_texture_file(const std::string& file);

// The units in which a file was read.
struct FileUnits {
  std::string file;
  HeightsUnits units;
};

// Heights along lines, of all files one after the other with a gap between. Throws Error for an areal map, or
// for files of unequal spacing. What is doubtful in the files, such as a sum that does not agree, goes to `problems`,
// their units to `units`.
HeightProfile read_strokes(const std::vector<std::string>& files, const ReadHeightsConfig& config,
                           Problems* problems = nullptr, std::vector<FileUnits>* units = nullptr);

// Heights over the plane: areal maps, tables with columns x, y and z (or height) whose names end in their
// unit, or profiles that lie `stroke_spacing_m` apart. Throws Error naming file and line.
std::vector<ArealSample> read_areal_samples(const std::vector<std::string>& files, const ReadHeightsConfig& config,
                                            double stroke_spacing_m, Problems* problems = nullptr,
                                            std::vector<FileUnits>* units = nullptr);

// Ra, Rq, Rz, Rt, Rsk, Rku and RSm of lines `spacing_m` apart, each the mean over the lines (of Rq the root mean
// square); values that are not defined are left out.
std::map<std::string, double> roughness_of(const std::vector<std::vector<double>>& lines_m, double spacing_m);

}  // namespace asperity
