#include "find_unobservable_dofs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "asperity/algebra/solve.h"
#include "choose_points.h"

namespace asperity::registration {
namespace {

// Motions that change the distances by more than this share of the points' motion are determined beyond doubt:
// interpolated normals, or facets, imitate less.
constexpr double kClear = 0.03;
constexpr double kClearOfFacets = 0.05;
// A motion less well known than this share of the guess's error keeps the guess: what little the distances say of
// it comes from single facets.
constexpr double kWorthless = 0.5;
constexpr std::size_t kSlidePoints = 500;
constexpr int kSlideIterations = 4;
constexpr double kChance = 10.0;

// Standard deviation along `v` by making the motion back and forth while the others follow.
class SlideTest {
 public:
  SlideTest(const RegistrationSurface& surface, const PointSet& points, const MatchRules& rules,
            const CentredPose& pose, double sigma_m, const RegistrationConfig& config)
      : points_(&points),
        pose_(pose),
        matcher_(surface, points, choose_uniform(points, kSlidePoints), rules),
        total_(static_cast<double>(points.size())),
        slide_m_(config.slide_m),
        sigma_m_(sigma_m) {
    options_.robust_sigmas = config.robust_sigmas;
    options_.isotropic = 0.0;
    options_.max_iterations = kSlideIterations;
    options_.reference = pose;
    options_.fixed_scale_m = std::max(sigma_m, 0.01 * config.slide_m);
  }

  // `noise_m` is what one point's distance would have to be wrong by, as its share of all points together.
  double sigma_m(const Vector6& v, const Matrix6& metric, const std::vector<Vector6>& others, double noise_m) {
    options_.holds.clear();
    for (const Vector6& other : others) options_.holds.push_back({metric * other, 0.0});
    options_.holds.push_back({metric * v, 0.0});
    const double still_m2 = cost_m2(pose_);
    double growth_m2 = std::numeric_limits<double>::infinity();
    for (const double step_m : {slide_m_, -slide_m_}) {
      options_.holds.back().target = step_m;
      growth_m2 = std::min(growth_m2, total_ * (cost_m2(moved(pose_, step_m * v)) - still_m2));
    }
    // Chance alone makes the two fits of so few points differ by this much.
    growth_m2 -= kChance * sigma_m_ * sigma_m_ * total_ / static_cast<double>(matcher_.size());
    return growth_m2 > 0.0 ? slide_m_ * noise_m / std::sqrt(growth_m2) : std::numeric_limits<double>::infinity();
  }

 private:
  double cost_m2(const CentredPose& start) {
    const Fit fit = fit_pose(matcher_, *points_, start, options_);
    return fit.cost_m2;
  }

  const PointSet* points_;
  CentredPose pose_;
  Matcher matcher_;
  FitOptions options_;
  double total_;
  double slide_m_;
  double sigma_m_;
};

// The same span with its translations first and its rotations after them, without the translations in them.
std::vector<Vector6> translations_then_rotations(const std::vector<Vector6>& motions, double radius_m) {
  if (motions.size() < 2) return motions;
  const auto k = static_cast<Eigen::Index>(motions.size());
  Eigen::Matrix<double, 6, Eigen::Dynamic> span(6, k);
  for (Eigen::Index i = 0; i < k; ++i) span.col(i) = motions[static_cast<std::size_t>(i)];
  const Eigen::MatrixXd rotations = radius_m * span.topRows<3>();
  const Eigen::MatrixXd V = singular_values(rotations, SingularVectors::kFullV).V;
  std::vector<Vector6> out;
  for (Eigen::Index i = k - 1; i >= 0; --i) out.emplace_back(span * V.col(i));
  return out;
}

}  // namespace

double facet_sag_m(const RegistrationSurface& surface, const Matcher& matcher) {
  double square = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < matcher.size(); ++i) {
    if (!matcher.matches()[i].usable) continue;
    const std::uint32_t t = matcher.closest()[i].triangle;
    const RegistrationFacet& facet = surface.facets[t];
    double sag_m = 0.0;
    for (std::size_t e = 0; e < 3; ++e) {
      const std::size_t f = (e + 1) % 3;
      const double edge_m = (surface.mesh->vertices_m[surface.mesh->triangles[t][f]] -
                             surface.mesh->vertices_m[surface.mesh->triangles[t][e]])
                                .norm();
      const double turn = static_cast<double>((facet.corner_normal[f] - facet.corner_normal[e]).norm());
      sag_m = std::max(sag_m, edge_m * turn / 8.0);
    }
    square += sag_m * sag_m;
    ++count;
  }
  return count == 0 ? 0.0 : std::sqrt(square / static_cast<double>(count));
}

Observability find_unobservable_dofs(const RegistrationSurface& surface, const PointSet& points,
                                     const MatchRules& rules, const Matcher& matcher, const CentredPose& pose,
                                     double sigma_m, const RegistrationConfig& config) {
  Observability out;
  out.metric = motion_metric(points, pose);
  const double limit_m = std::max(config.outlier_sigmas * sigma_m, 1e-6 * points.radius_m);
  // Every point counts once, however many of them the fit used.
  const double share = static_cast<double>(points.size()) / static_cast<double>(matcher.size());
  const Matrix6 info = share * information(matcher, pose, limit_m);
  const SymmetricEigen motions = symmetric_eigen(info, out.metric);
  const double n = static_cast<double>(points.size());
  const double surface_m = std::hypot(config.surface_error_m, facet_sag_m(surface, matcher));
  const double noise_m = std::hypot(sigma_m, std::sqrt(n) * surface_m);
  // The noise across a path that is nearly straight imitates a lever of its own.
  const double clear = (rules.normals == RegistrationNormals::kFacet ? kClearOfFacets : kClear) +
                       (is_thin(points) ? 20.0 * sigma_m / points.radius_m : 0.0);

  SlideTest test(surface, points, rules, pose, sigma_m, config);
  const double prior = config.guess_sigma_m;
  for (int k = 0; k < 6; ++k) {
    const Vector6 v = motions.vectors.col(k);
    const double lambda = std::max(motions.values[k], 0.0);
    bool unobservable = false;
    double along_m = lambda > 0.0 ? sigma_m / std::sqrt(lambda) : std::numeric_limits<double>::infinity();
    if (std::sqrt(lambda / n) < clear || along_m > config.undetermined_m) {
      const double slid_m = test.sigma_m(v, out.metric, out.unobservable, noise_m);
      along_m = std::max(along_m, slid_m);
      if (slid_m > config.undetermined_m) {
        unobservable = true;
        out.unobservable.push_back(v);
        out.unobservable_sigma_m = std::max(out.unobservable_sigma_m, slid_m);
        if (slid_m > kWorthless * config.guess_sigma_m) out.held.push_back(v);
      }
    }
    const double variance_m2 = 1.0 / (1.0 / (along_m * along_m) + 1.0 / (prior * prior));
    out.covariance += variance_m2 * v * v.transpose();
    if (!unobservable) out.determined_rms_m += variance_m2;
  }
  out.determined_rms_m = std::sqrt(out.determined_rms_m);
  out.unobservable = translations_then_rotations(out.unobservable, points.radius_m);
  return out;
}

void append_uncertain_rotations(const PathChain& chain, double limit_rad, RegistrationResult& result) {
  const Eigen::Matrix3d rotation_covariance = result.covariance.topLeftCorner<3, 3>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(rotation_covariance);
  for (int k = 0; k < 3; ++k) {
    const double sigma_rad = std::sqrt(std::max(0.0, solver.eigenvalues()[k]));
    if (!(sigma_rad > limit_rad)) continue;
    const Eigen::Vector3d axis = solver.eigenvectors().col(k);
    const bool listed = std::any_of(result.undetermined.begin(), result.undetermined.end(), [&](const auto& other) {
      return other.rotation_rad.norm() > 0.0 && std::abs(other.rotation_rad.normalized().dot(axis)) > 0.9;
    });
    if (listed) continue;
    // The shift that goes with the rotation in the data.
    const Eigen::Vector3d shift = result.covariance.bottomLeftCorner<3, 3>() * axis / (sigma_rad * sigma_rad);
    double moved_m2 = 0.0;
    for (const Eigen::Vector3d& p_m : chain.p_world_m) {
      if (!p_m.allFinite()) continue;
      const Eigen::Vector3d arm = result.T_mesh_world * p_m - result.centre_mesh_m;
      moved_m2 += (axis.cross(arm) + shift).squaredNorm() / static_cast<double>(chain.p_world_m.size());
    }
    const double scale = 1.0 / std::sqrt(moved_m2);
    if (!std::isfinite(scale)) continue;
    UndeterminedMotion motion;
    motion.rotation_rad = scale * axis;
    motion.shift_m = scale * shift;
    motion.centre_mesh_m = result.centre_mesh_m;
    motion.sigma_m = sigma_rad / scale;
    motion.description = fmt::format("rotations about ({:.2f}, {:.2f}, {:.2f}) are known to {:.1f} degrees only",
                                     axis.x(), axis.y(), axis.z(), sigma_rad * 180.0 / std::numbers::pi);
    result.undetermined.push_back(motion);
  }
}

UndeterminedMotion describe_motion(const Vector6& motion, const Eigen::Vector3d& centre_m, double sigma_m,
                                   double radius_m) {
  UndeterminedMotion out;
  out.rotation_rad = motion.head<3>();
  out.shift_m = motion.tail<3>();
  out.centre_mesh_m = centre_m;
  out.sigma_m = sigma_m;
  const double rotation_rad = out.rotation_rad.norm();
  // One sense for a direction and its opposite: the largest component positive.
  const auto direction = [](const Eigen::Vector3d& a) {
    Eigen::Index largest = 0;
    a.cwiseAbs().maxCoeff(&largest);
    Eigen::Vector3d d = a.normalized() * (a(largest) < 0.0 ? -1.0 : 1.0);
    for (int k = 0; k < 3; ++k) d(k) = std::abs(d(k)) < 0.005 ? 0.0 : d(k);  // no "-0.00"
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", d.x(), d.y(), d.z());
  };
  if (rotation_rad * radius_m < 0.1 * out.shift_m.norm()) {
    out.description = "sliding along " + direction(out.shift_m);
    return out;
  }
  const Eigen::Vector3d axis = out.rotation_rad / rotation_rad;
  const Eigen::Vector3d through_m = centre_m + axis.cross(out.shift_m) / rotation_rad;
  out.description = fmt::format("rotation about the axis through ({:.1f}, {:.1f}, {:.1f}) mm along {}",
                                1e3 * through_m.x(), 1e3 * through_m.y(), 1e3 * through_m.z(), direction(axis));
  const double along_m = axis.dot(out.shift_m);
  if (std::abs(along_m) > 0.1 * rotation_rad * radius_m) out.description += ", sliding along it";
  return out;
}

}  // namespace asperity::registration
