#include "search_poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "choose_points.h"
#include "distance_grid.h"
#include "surface_samples.h"

namespace asperity::registration {

namespace {

// Rotation i of n, evenly spread (Alexa, Super-Fibonacci Spirals, 2022).
Eigen::Quaterniond spiral_rotation(int i, int n) {
  const double phi = std::numbers::sqrt2;
  const double psi = 1.533751168755204288118041;
  const double s = i + 0.5;
  const double r = std::sqrt(s / n);
  const double big_r = std::sqrt(1.0 - s / n);
  const double alpha = 2.0 * std::numbers::pi * s / phi;
  const double beta = 2.0 * std::numbers::pi * s / psi;
  return {big_r * std::cos(beta), r * std::sin(alpha), r * std::cos(alpha), big_r * std::sin(beta)};
}

// Some of the points with what the probe's directions say, ready for the grid.
struct FewPoints {
  std::vector<Eigen::Vector3f> x_m, outward;
  float facing_cos = -1.0F;
};

FewPoints few_points(const PointSet& points, std::size_t count, bool use_outward, double facing_cos) {
  FewPoints out;
  for (const std::uint32_t i : choose_uniform(points, count)) {
    out.x_m.push_back(points.x_m[i].cast<float>());
    out.outward.push_back(points.outward[i].cast<float>());
  }
  out.facing_cos = use_outward ? static_cast<float>(facing_cos) : -2.0F;
  return out;
}

// Geman and McClure's cost, d²/(1 + d²/width²): of `width²` for a point far away or on the wrong side. The sums of a
// Gauss–Newton step are added where they are asked for.
struct GridSums {
  Eigen::Matrix<float, 6, 6> hessian = Eigen::Matrix<float, 6, 6>::Zero();
  Eigen::Matrix<float, 6, 1> gradient = Eigen::Matrix<float, 6, 1>::Zero();
  float weight = 0.0F;
};

float grid_cost(const DistanceGrid& grid, const FewPoints& few, const CentredPose& pose, float width_m,
                GridSums* sums) {
  const Eigen::Matrix3f R = pose.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f centre_m = pose.centre_m.cast<float>();
  const float inverse = 1.0F / (width_m * width_m);
  float cost = 0.0F;
  for (std::size_t i = 0; i < few.x_m.size(); ++i) {
    const Eigen::Vector3f arm = R * few.x_m[i];
    const DistanceGrid::Sample sample = grid.at(arm + centre_m);
    const float share = 1.0F / (1.0F + sample.distance_m * sample.distance_m * inverse);
    const bool faces = few.facing_cos < -1.0F || (R * few.outward[i]).dot(sample.gradient) > few.facing_cos;
    cost += faces ? sample.distance_m * sample.distance_m * share : width_m * width_m;
    if (sums == nullptr || !faces) continue;
    const float weight = share * share;
    Eigen::Matrix<float, 6, 1> j;
    j << arm.cross(sample.gradient), sample.gradient;
    sums->hessian += weight * j * j.transpose();
    sums->gradient += weight * sample.distance_m * j;
    sums->weight += weight;
  }
  return cost / static_cast<float>(few.x_m.size());
}

struct GridRun {
  CentredPose pose;
  float cost = 0.0F;
  int starts = 1;
};

// Steps with a width that narrows by the factor `narrow` from `width_m`, and the cost at the last.
void descend_on_grid(const DistanceGrid& grid, const FewPoints& few, const Matrix6& metric, float width_m, float narrow,
                     int steps, GridRun& run) {
  constexpr double kGridDamping = 0.01, kMostTurn = 0.35;
  for (int k = 0; k < steps; ++k, width_m *= narrow) {
    GridSums sums;
    grid_cost(grid, few, run.pose, width_m, &sums);
    if (!(sums.weight > 0.0F)) break;
    const Matrix6 hessian = sums.hessian.cast<double>() + kGridDamping * static_cast<double>(sums.weight) * metric;
    Vector6 step = -hessian.llt().solve(sums.gradient.cast<double>());
    if (!step.allFinite()) break;
    const double turn = step.head<3>().norm(), shift_m = step.tail<3>().norm();
    const double most_m = 0.15 * grid.size_m();
    step *= std::min({1.0, kMostTurn / std::max(turn, 1e-12), most_m / std::max(shift_m, 1e-12)});
    run.pose = moved(run.pose, step);
  }
  run.cost = grid_cost(grid, few, run.pose, width_m, nullptr);
}

// The best `keep` of the runs that are farther apart than `same_m`, with the starts of the others.
std::vector<GridRun> distinct_runs(std::vector<GridRun> runs, const PointSet& points, double same_m, std::size_t keep) {
  std::stable_sort(runs.begin(), runs.end(), [](const GridRun& a, const GridRun& b) { return a.cost < b.cost; });
  std::vector<GridRun> out;
  for (const GridRun& run : runs) {
    const auto known = std::find_if(out.begin(), out.end(), [&](const GridRun& better) {
      return (better.pose.centre_m - run.pose.centre_m).squaredNorm() < same_m * same_m &&
             rms_between(points, better.pose, run.pose) < same_m;
    });
    if (known != out.end()) {
      known->starts += run.starts;
    } else if (out.size() < keep) {
      out.push_back(run);
    }
  }
  return out;
}

}  // namespace

std::vector<SearchEnd> search_poses(const RegistrationSurface& surface, const PointSet& points, bool use_outward,
                                    double facing_cos, const SearchConfig& config, std::size_t keep,
                                    const Observer& observer) {
  constexpr double kLean = 0.5;     // of the probe from the normal: 60°
  constexpr float kScored = 0.06F;  // widths, of the mesh's diagonal
  constexpr float kNarrowest = 0.004F;
  constexpr double kSame = 0.012;
  const DistanceGrid& grid = surface.search_grid->of(surface, observer);
  const auto size_m = static_cast<float>(grid.size_m());
  const FewPoints few = few_points(points, static_cast<std::size_t>(config.points), use_outward, facing_cos);
  const std::uint32_t anchor = static_cast<std::uint32_t>(points.size() / 2);
  std::vector<GridRun> runs;
  const auto most = static_cast<std::size_t>(config.grid_runs);
  const auto keep_best = [&] {
    if (runs.size() <= most) return;
    std::nth_element(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(most), runs.end(),
                     [](const GridRun& a, const GridRun& b) { return a.cost < b.cost; });
    runs.resize(most);
  };
  const std::vector<SurfaceSample> positions = spread_over(*surface.mesh, config.positions);
  for (int i = 0; i < config.rotations; ++i) {
    observer.update("search", 0.3 + 0.2 * static_cast<double>(i) / config.rotations);
    const Eigen::Quaterniond rotation = spiral_rotation(i, config.rotations);
    const Eigen::Vector3d outward = rotation * points.outward[anchor];
    for (const SurfaceSample& at : positions) {
      if (use_outward && outward.dot(at.n) < kLean) continue;
      GridRun run{{rotation, at.p_m - rotation * points.x_m[anchor]}, 0.0F, 1};
      run.cost = grid_cost(grid, few, run.pose, kScored * size_m, nullptr);
      runs.push_back(run);
    }
    if (runs.size() > 8 * most) keep_best();
  }
  keep_best();
  if (runs.empty()) return {};
  const Matrix6 metric_here = motion_metric(points, runs.front().pose);
  // A metric for all: of the points' size, the same in all directions.
  Matrix6 metric = Matrix6::Identity();
  metric.topLeftCorner<3, 3>() *= metric_here.topLeftCorner<3, 3>().trace() / 3.0;
  const float narrow = std::pow(kNarrowest / kScored, 1.0F / 9.0F);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i % 256 == 0) observer.update("search", 0.5 + 0.3 * static_cast<double>(i) / static_cast<double>(runs.size()));
    descend_on_grid(grid, few, metric, kScored * size_m, narrow, 10, runs[i]);
  }
  runs =
      distinct_runs(std::move(runs), points, kSame * grid.size_m(), 4 * static_cast<std::size_t>(config.coarse_runs));
  const FewPoints more = few_points(points, static_cast<std::size_t>(config.coarse_points), use_outward, facing_cos);
  for (GridRun& run : runs) {
    observer.update("search", 0.8);
    descend_on_grid(grid, more, metric, 0.012F * size_m, 0.85F, 8, run);
  }
  runs = distinct_runs(std::move(runs), points, 0.5 * kSame * grid.size_m(), keep);
  std::vector<SearchEnd> out;
  for (const GridRun& run : runs) out.push_back({run.pose, run.starts});
  return out;
}

}  // namespace asperity::registration
