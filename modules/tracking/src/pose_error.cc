#include "pose_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Cholesky>

#include "asperity/recording/camera_model.h"
#include "shared_error.h"

namespace asperity {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int kDegree = 3;
constexpr double kFall = 0.4;
constexpr int kModes = (kDegree + 1) * (kDegree + 2);  // of x and of y
constexpr int kUnknowns = 6 + kModes;
constexpr int kColumns = kUnknowns + 1;  // and the residual
using ModeVector = Eigen::Matrix<double, kModes, 1>;
using Moments = Eigen::Matrix<double, kColumns, kColumns>;

// Legendre's polynomial of unit mean square over [−1, 1].
double legendre(int degree, double x) {
  constexpr double kRoot3 = 1.7320508075688772, kRoot5 = 2.23606797749979, kRoot7 = 2.6457513110645907;
  switch (degree) {
    case 0:
      return 1.0;
    case 1:
      return kRoot3 * x;
    case 2:
      return kRoot5 * 0.5 * (3.0 * x * x - 1.0);
    default:
      return kRoot7 * 0.5 * (5.0 * x * x * x - 3.0 * x);
  }
}

// A standard deviation of each mode: smaller from one degree to the next, as a rolling shutter moves corners in the
// first degree, a sag in the second and a lens in the third.
ModeVector mode_sigmas() {
  ModeVector out;
  int k = 0;
  for (int degree = 0; degree <= kDegree; ++degree) {
    for (int i = 0; i <= 2 * degree + 1; ++i) out[k++] = std::pow(kFall, degree);
  }
  return out;
}

// The body's view: the box of its corners in the image, no narrower than half its length.
struct View {
  Eigen::Vector2d middle_px, half_px;
};

View view_of(std::span<const CornersAtPose> corners, const std::vector<Eigen::Matrix<double, 8, 1>>& seen_px) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      if (!corners[i].used[static_cast<std::size_t>(k)]) continue;
      low = low.cwiseMin(seen_px[i].segment<2>(2 * k));
      high = high.cwiseMax(seen_px[i].segment<2>(2 * k));
    }
  }
  View out{0.5 * (low + high), 0.5 * (high - low)};
  out.half_px = out.half_px.cwiseMax(0.5 * out.half_px.maxCoeff()).cwiseMax(1.0);
  return out;
}

// What the modes move a tag's corners by, px; times the modes' standard deviations.
Eigen::Matrix<double, 8, kModes> modes_at(const View& view, const Eigen::Matrix<double, 8, 1>& seen_px,
                                          const ModeVector& sigmas) {
  Eigen::Matrix<double, 8, kModes> out = Eigen::Matrix<double, 8, kModes>::Zero();
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector2d at = (seen_px.segment<2>(2 * corner) - view.middle_px).cwiseQuotient(view.half_px);
    int k = 0;
    for (int degree = 0; degree <= kDegree; ++degree) {
      for (int i = 0; i <= degree; ++i, k += 2) {
        const double value = legendre(i, at.x()) * legendre(degree - i, at.y());
        out(2 * corner, k) = value * sigmas[k];
        out(2 * corner + 1, k + 1) = value * sigmas[k + 1];
      }
    }
  }
  return out;
}

// The rows of the corners in use: the shared errors' columns, J, Φ, r.
struct TagRows {
  Eigen::MatrixXd columns;
  Eigen::MatrixXd covariance;
};

TagRows rows_of(const CornersAtPose& tag, const SharedColumns& shared, const Eigen::Matrix<double, 8, kModes>& modes,
                const Eigen::Matrix<double, 8, 8>& placement, const Eigen::Matrix<double, 6, 1>& scale) {
  std::array<int, 8> index{};
  int count = 0;
  for (int k = 0; k < 8; ++k) {
    if (tag.used[static_cast<std::size_t>(k / 2)]) index[static_cast<std::size_t>(count++)] = k;
  }
  TagRows out;
  out.columns.resize(count, shared.cols() + kColumns);
  out.covariance.resize(count, count);
  for (int i = 0; i < count; ++i) {
    const int row = index[static_cast<std::size_t>(i)];
    out.columns.row(i) << shared.row(row), tag.by_pose.row(row).cwiseProduct(scale.transpose()), modes.row(row),
        tag.residual_px[row];
    for (int j = 0; j < count; ++j) {
      const int column = index[static_cast<std::size_t>(j)];
      out.covariance(i, j) = tag.covariance_px2(row, column) + placement(row, column);
    }
  }
  return out;
}

// Density of a half-t with 4 degrees of freedom by the logarithm of `size`, up to a factor.
double log_prior(double size, double scale) {
  const double ratio = size / scale;
  return std::log(ratio) - 2.5 * std::log1p(0.25 * ratio * ratio);
}

struct Sizes {
  double corner2_px2 = 0.0, smooth2_px2 = 0.0;  // posterior means of a² and c²
};

Sizes find_sizes(const std::vector<TagRows>& tags, double prior_px) {
  constexpr int kSizeSteps = 13;
  constexpr double kLeast_px = 0.00125;  // doubled from step to step, up to 5 px
  std::array<std::array<double, kSizeSteps>, kSizeSteps> log_p{};
  double best = -std::numeric_limits<double>::infinity();
  const auto size_px = [](int step) { return std::ldexp(kLeast_px, step); };
  const Eigen::Index known = tags.front().columns.cols() - kColumns;
  for (int a = 0; a < kSizeSteps; ++a) {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(known + kColumns, known + kColumns);
    double log_determinant = 0.0;
    for (const TagRows& tag : tags) {
      Eigen::MatrixXd covariance = tag.covariance;
      covariance.diagonal().array() += size_px(a) * size_px(a);
      const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
      const Eigen::MatrixXd white = factor.matrixL().solve(tag.columns);
      all.noalias() += white.transpose() * white;
      for (Eigen::Index i = 0; i < covariance.rows(); ++i) log_determinant += 2.0 * std::log(factor.matrixLLT()(i, i));
    }
    // ∫ over the shared errors, of unit variance.
    all.diagonal().head(known).array() += 1.0;
    const Eigen::LLT<Eigen::MatrixXd> shared(all.topLeftCorner(known, known));
    for (Eigen::Index i = 0; i < known; ++i) log_determinant += 2.0 * std::log(shared.matrixLLT()(i, i));
    const Eigen::MatrixXd across = shared.matrixL().solve(all.topRightCorner(known, kColumns));
    Moments moments = all.bottomRightCorner<kColumns, kColumns>();
    moments.noalias() -= across.transpose() * across;
    // Residuals that vanish leave no pivot.
    constexpr double kRounding = 1e-9;
    moments(kUnknowns, kUnknowns) += kRounding;
    for (int c = 0; c < kSizeSteps; ++c) {
      // ∫ over the pose and β; Φ holds the modes' standard deviations already.
      Moments m = moments;
      m.diagonal().segment<kModes>(6).array() += 1.0 / (size_px(c) * size_px(c));
      const Eigen::LLT<Moments> factor(m);
      if (factor.info() != Eigen::Success) {
        log_p[static_cast<std::size_t>(a)][static_cast<std::size_t>(c)] = -std::numeric_limits<double>::infinity();
        continue;
      }
      double log_p_here = log_prior(size_px(a), prior_px) + log_prior(size_px(c), prior_px) - 0.5 * log_determinant -
                          kModes * std::log(size_px(c));
      for (int k = 0; k < kUnknowns; ++k) log_p_here -= std::log(factor.matrixLLT()(k, k));
      // The last pivot is what of the residual is explained by neither.
      const double left = factor.matrixLLT()(kUnknowns, kUnknowns);
      log_p_here -= 0.5 * left * left;
      log_p[static_cast<std::size_t>(a)][static_cast<std::size_t>(c)] = log_p_here;
      best = std::max(best, log_p_here);
    }
  }
  Sizes out;
  double sum = 0.0;
  for (int a = 0; a < kSizeSteps; ++a) {
    for (int c = 0; c < kSizeSteps; ++c) {
      const double p = std::exp(log_p[static_cast<std::size_t>(a)][static_cast<std::size_t>(c)] - best);
      sum += p;
      out.corner2_px2 += p * size_px(a) * size_px(a);
      out.smooth2_px2 += p * size_px(c) * size_px(c);
    }
  }
  if (sum > 0.0) {
    out.corner2_px2 /= sum;
    out.smooth2_px2 /= sum;
  }
  return out;
}

}  // namespace

PoseError find_pose_error(const CameraCalibration& camera, const std::vector<MarkerPlacement>& body, const Pose& pose,
                          std::span<const CornersAtPose> corners, std::span<const std::size_t> tag_of,
                          const Matrix6& normal, const BodyPoseConfig& config) {
  std::vector<Eigen::Matrix<double, 8, 1>> seen_px;
  for (const CornersAtPose& tag : corners) {
    Eigen::Matrix<double, 8, 1> px;
    for (int k = 0; k < 4; ++k) {
      const auto pixel = project(camera, pose * tag.p_marker_m.col(k));
      px.segment<2>(2 * k) = pixel.value_or(Eigen::Vector2d::Zero());
    }
    seen_px.push_back(px);
  }
  const View view = view_of(corners, seen_px);
  const ModeVector sigmas = mode_sigmas();
  const Eigen::Matrix<double, 6, 1> scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Matrix6> solver(normal);
  const std::vector<SharedColumns> shared = shared_columns(camera, body, pose, corners, tag_of, config);
  const double placement2_m2 = config.placement_sigma_m * config.placement_sigma_m;

  std::vector<TagRows> rows;
  PoseError out;
  out.shared.setZero();
  Matrix6 own = Matrix6::Zero(), independent = Matrix6::Zero();
  Eigen::Matrix<double, 6, kModes> smooth = Eigen::Matrix<double, 6, kModes>::Zero();
  Eigen::Matrix<double, 6, Eigen::Dynamic> by_shared =
      Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, shared.front().cols());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const CornersAtPose& tag = corners[i];
    const auto modes = modes_at(view, seen_px[i], sigmas);
    const Eigen::Matrix<double, 6, 8> P = solver.solve(tag.weighed);
    const Eigen::Matrix<double, 8, 8> placement =
        placement2_m2 * tag.by_pose.leftCols<3>() * tag.by_pose.leftCols<3>().transpose();
    own.noalias() += P * tag.covariance_px2 * P.transpose();
    out.shared.noalias() += P * placement * P.transpose();
    independent.noalias() += P * P.transpose();
    smooth.noalias() += P * modes;
    by_shared.noalias() += P * shared[i];
    rows.push_back(rows_of(tag, shared[i], modes, placement, scale));
  }
  out.shared.noalias() += by_shared * by_shared.transpose();
  out.shared = (0.5 * (out.shared + out.shared.transpose())).eval();
  const Sizes sizes = find_sizes(rows, config.unmodelled_px);
  out.corner_px = std::sqrt(sizes.corner2_px2);
  out.smooth_px = std::sqrt(sizes.smooth2_px2);
  out.noise = own + sizes.corner2_px2 * independent + sizes.smooth2_px2 * smooth * smooth.transpose();
  out.noise = (0.5 * (out.noise + out.noise.transpose())).eval();
  return out;
}

}  // namespace asperity
