#include "path_blocks.h"

#include <algorithm>
#include <cmath>

namespace asperity::registration {

namespace {

constexpr double kPerShortest = 4.0;    // points of a block as short as they come
constexpr double kMostBlocks = 1500.0;  // of a path

}  // namespace

PathBlocks divide_into_blocks(std::span<const MeasuredPath> paths, const PointSet& points, const WeighConfig& config) {
  PathBlocks out;
  std::size_t begin = 0;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    PathBlocks::Path& path = out.paths.emplace_back();
    const Eigen::Matrix3d& C = paths[p].slow_covariance_world_m2;
    const bool known = C.allFinite() && C.trace() > 0.0;
    out.stated = out.stated && known;
    const double usual_m = kUnstatedDrift * points.radius_m;
    path.covariance_m2 = known ? C : Eigen::Matrix3d(usual_m * usual_m * Eigen::Matrix3d::Identity());
    std::size_t end = begin;
    while (end < points.size() && points.path[end] == p) ++end;
    // By the path alone: evidences of several paths together and of each by itself are compared.
    const double length_m = end > begin ? points.s_m[end - 1] - points.s_m[begin] : 0.0;
    const double shortest_m = std::max(config.memory_m, length_m / kMostBlocks);
    path.relief = measure_relief(std::span(points.x_m).subspan(begin, end - begin),
                                 std::span(points.s_m).subspan(begin, end - begin), shortest_m);
    path.first = out.blocks.size();
    const auto most = static_cast<std::size_t>(std::lround(kPerShortest * path.relief.block_m / shortest_m));
    while (begin < end) {
      std::size_t next = begin + 1;
      while (next < end && points.s_m[next] - points.s_m[begin] < path.relief.block_m) ++next;
      const std::size_t count = std::min(most, next - begin), first = out.chosen.size();
      for (std::size_t k = 0; k < count; ++k) {
        out.chosen.push_back(static_cast<std::uint32_t>(begin + (2 * k + 1) * (next - begin) / (2 * count)));
      }
      out.blocks.push_back({points.s_m[out.chosen[first]], first, count});
      begin = next;
    }
    path.count = out.blocks.size() - path.first;
  }
  return out;
}

}  // namespace asperity::registration
