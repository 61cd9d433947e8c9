#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "asperity/base/progress.h"
#include "asperity/pipeline/make_area.h"
#include "asperity/session/area_input.h"
#include "asperity/studio/block.h"
#include "asperity/studio/hub.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

// Many registered scans as one areal texture, as `asperity area` makes it. Immutable once made: shared by threads.
struct AlignArea {
  std::string folder;  // that `register` wrote, by its name in the project
  AreaInput input;
  AreaResult result;
};

// Folders of the project that `register` wrote, which an area can be made of: their names.
Json list_registered(const Project& project);

// Throws Error as read_area_input() and make_area() do, and Cancelled.
std::shared_ptr<const AlignArea> make_align_area(const std::string& name, const std::filesystem::path& folder,
                                                 const AreaConfig& config, const Observer& observer);

// The mesh block (mesh_block.h) of kind "align.area" with the area. Head: "folder"; "area", what area.json states;
// "map"
// {"columns","rows","every","spacing_m"}, null without a map: every `every`-th point of the grid, the first at x = y =
// 0. Arrays: height_m and sigma_m f32, supported u8 [rows, columns], row after row along x; triangle u32 [n] of the
// mesh that have the texture, with their corners' xy_mm f32 [n, 3, 2] in the map.
BlockWriter area_block(const AlignArea& area);

// Writes what `asperity area` writes into the project's folder `name`, all or nothing. Gives {"name","scene","files",
// "command"}, `files` the pictures. Throws Advice without an area, Error if the folder is something else than ours.
Json write_align_area(const AlignArea& area, const Project& project, const std::string& name, Hub& hub);

}  // namespace asperity::studio
