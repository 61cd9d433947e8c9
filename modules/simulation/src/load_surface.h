#pragma once

#include <memory>

#include "asperity/base/problem.h"
#include "asperity/simulation/surface.h"
#include "asperity/simulation/surface_config.h"

namespace asperity {

// Reads `config.file`: an instrument's file (GSF, SDF, SUR, X3P, SMD: surface/parse_surface_file.h) without missing
// points; a TIFF of heights in `file_unit_m`, `file_spacing_m` apart, which must be given; tables of stylus instruments
// and other programs, a profile.csv (texture_m, else height_m) and with `file_spacing_m` a column with decimal commas
// (profile/read_heights.h; `file_units`); or text, comma separated, with or without a header line; blank lines are
// passed over.
//   one column     heights, `file_spacing_m` apart (0: 0.5 µm)
//   two columns    position along the stroke and height, positions uniform (as s_m,height_m)
//   three columns  x_mm,y_mm,z_um: an areal map on a full rectangular grid, along x or along y (read_areal_map)
// A header's names carry units by their ends (_m, _cm, _mm, _um, _nm); without one a profile's heights are in
// `file_unit_m` and its positions in metres, and a map is as above. A profile loses its mean, a map its least-squares
// plane. Beyond its border a relief goes on as its mirror image, so that it has no steps. Throws Error naming file,
// line and value; files over 64 MiB and heights beyond 0.1 m are refused. A checksum of the file that does not hold is
// added to `problems` ("checksum").
std::unique_ptr<Surface> load_surface(const SimulatedSurfaceConfig& config, Problems* problems = nullptr);

}  // namespace asperity
