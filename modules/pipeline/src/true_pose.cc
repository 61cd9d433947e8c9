#include "asperity/pipeline/true_pose.h"

#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/json/parse_json.h"
#include "json.h"

namespace asperity {

std::optional<Pose> true_pose(const Recording& recording) {
  const Json extra = parse_json_or_null(recording.info.extra_json);
  if (!extra.is_object() || !extra.contains("T_mesh_world")) return std::nullopt;
  const Json& v = extra["T_mesh_world"];
  const std::string fault = "recording: extra.T_mesh_world is not x, y, z, qw, qx, qy, qz";
  if (!v.is_array() || v.size() != 7) throw Error(fault);
  for (const Json& one : v) {
    if (!one.is_number() || !std::isfinite(one.get<double>())) throw Error(fault);
  }
  Pose out;
  const auto number = [&v](std::size_t i) { return v[i].get<double>(); };
  out.translation_m = {number(0), number(1), number(2)};
  out.rotation = Eigen::Quaterniond(number(3), number(4), number(5), number(6));
  if (std::abs(out.rotation.norm() - 1.0) > 1e-3) throw Error(fault);
  out.rotation.normalize();
  return out;
}

}  // namespace asperity
