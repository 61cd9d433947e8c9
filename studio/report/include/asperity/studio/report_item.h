#pragma once

#include <string>

namespace asperity::studio {

// One result as report.html holds it: its name, and a block (block.h) with
//   head    "name", "result" (the content of result.json), "path_points" and "profile_points" (how many there were;
//           fewer are in the arrays if there were more than can be seen)
//   arrays  the profile: s_m, height_m, sigma_m, texture_m, force_N, speed_mps, f32, nan in gaps; the tip's path in
//           the world frame: path_t_s from its beginning, path_m [n,3], f32; of a path that was not kept, empty
struct ReportItem {
  std::string name;
  std::string block;
};

}  // namespace asperity::studio
