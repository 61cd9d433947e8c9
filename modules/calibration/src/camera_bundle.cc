#include "camera_bundle.h"

#include <cmath>
#include <limits>

#include "asperity/algebra/solve.h"

namespace asperity {

namespace {

using PoseMatrix = Eigen::Matrix<double, 6, 6>;
using PoseVector = Eigen::Matrix<double, 6, 1>;
using CrossMatrix = Eigen::Matrix<double, kCameraParameters, 6>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Projection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, kCameraParameters> by_camera;
  Eigen::Matrix<double, 2, 6> by_pose;  // rotation from the left, then translation
};

// False behind the camera.
bool project_pixel(const CameraVector& c, const Eigen::Vector3d& p, Eigen::Vector2d& pixel) {
  if (!(p.z() > 0.0)) return false;
  const double x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (c[4] + r2 * (c[5] + r2 * c[8]));
  pixel.x() = c[0] * (x * radial + 2.0 * c[6] * x * y + c[7] * (r2 + 2.0 * x * x)) + c[2];
  pixel.y() = c[1] * (y * radial + c[6] * (r2 + 2.0 * y * y) + 2.0 * c[7] * x * y) + c[3];
  return true;
}

bool project_with_slopes(const CameraVector& c, const Pose& T_camera_board, const Eigen::Vector3d& p_board_m,
                         Projection& out) {
  const Eigen::Vector3d turned = T_camera_board.rotation * p_board_m;
  const Eigen::Vector3d p = turned + T_camera_board.translation_m;
  if (!(p.z() > 0.0)) return false;
  const double x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
  const double k1 = c[4], k2 = c[5], p1 = c[6], p2 = c[7], k3 = c[8];
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = k1 + r2 * (2.0 * k2 + 3.0 * k3 * r2);  // of the radial factor by r²
  const double xd = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x);
  const double yd = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
  out.pixel = {c[0] * xd + c[2], c[1] * yd + c[3]};
  out.by_camera.row(0) << xd, 0.0, 1.0, 0.0, c[0] * x * r2, c[0] * x * r2 * r2, c[0] * 2.0 * x * y,
      c[0] * (r2 + 2.0 * x * x), c[0] * x * r2 * r2 * r2;
  out.by_camera.row(1) << 0.0, yd, 0.0, 1.0, c[1] * y * r2, c[1] * y * r2 * r2, c[1] * (r2 + 2.0 * y * y),
      c[1] * 2.0 * x * y, c[1] * y * r2 * r2 * r2;
  Eigen::Matrix2d by_ray;
  by_ray(0, 0) = c[0] * (radial + 2.0 * x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x);
  by_ray(0, 1) = c[0] * (2.0 * x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y);
  by_ray(1, 0) = c[1] * (2.0 * x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y);
  by_ray(1, 1) = c[1] * (radial + 2.0 * y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x);
  Eigen::Matrix<double, 2, 3> ray_by_point;
  ray_by_point << 1.0 / p.z(), 0.0, -x / p.z(), 0.0, 1.0 / p.z(), -y / p.z();
  const Eigen::Matrix<double, 2, 3> by_point = by_ray * ray_by_point;
  out.by_pose.leftCols<3>() = -by_point * skew(turned);
  out.by_pose.rightCols<3>() = by_point;
  return true;
}

struct ViewNormals {
  CameraMatrix camera = CameraMatrix::Zero();
  CrossMatrix cross = CrossMatrix::Zero();
  PoseMatrix pose = PoseMatrix::Zero();
  CameraVector camera_gradient = CameraVector::Zero();
  PoseVector pose_gradient = PoseVector::Zero();
};

ViewNormals normals_of(const BoardView& view, const CameraBundle& bundle, const Pose& T_camera_board) {
  ViewNormals n;
  Projection projection;
  for (std::size_t i = 0; i < view.corner_px.size(); ++i) {
    if (!project_with_slopes(bundle.parameters, T_camera_board, view.p_board_m[i], projection)) continue;
    for (std::size_t k = 0; k < kCameraParameters; ++k) {
      if (!bundle.free[k]) projection.by_camera.col(static_cast<Eigen::Index>(k)).setZero();
    }
    const Eigen::Vector2d residual = view.corner_px[i] - projection.pixel;
    n.camera.noalias() += projection.by_camera.transpose() * projection.by_camera;
    n.cross.noalias() += projection.by_camera.transpose() * projection.by_pose;
    n.pose.noalias() += projection.by_pose.transpose() * projection.by_pose;
    n.camera_gradient.noalias() += projection.by_camera.transpose() * residual;
    n.pose_gradient.noalias() += projection.by_pose.transpose() * residual;
  }
  return n;
}

PoseMatrix damped(const PoseMatrix& matrix, double damping) {
  PoseMatrix out = matrix;
  out.diagonal() *= 1.0 + damping;
  return out;
}

// A view's pose step is alone − by_camera · the camera's step (Schur's complement).
struct EliminatedPose {
  PoseVector alone;
  Eigen::Matrix<double, 6, kCameraParameters> by_camera;
};

EliminatedPose eliminate_pose(const PoseMatrix& pose, const ViewNormals& n) {
  Eigen::Matrix<double, 6, kCameraParameters + 1> right;
  right << n.pose_gradient, n.cross.transpose();
  const Eigen::MatrixXd solved = solve_symmetric(pose, right);
  return {solved.col(0), solved.rightCols<kCameraParameters>()};
}

struct Step {
  CameraVector camera;
  std::vector<PoseVector> poses;
  double predicted_px2 = 0.0;  // how much less the sum of squares becomes if the problem is linear
};

Step solve_step(const std::vector<ViewNormals>& normals, const CameraBundle& bundle, double damping) {
  CameraMatrix reduced = CameraMatrix::Zero();
  CameraVector right = CameraVector::Zero();
  std::vector<EliminatedPose> poses;
  poses.reserve(normals.size());
  for (const ViewNormals& n : normals) {
    const EliminatedPose& pose = poses.emplace_back(eliminate_pose(damped(n.pose, damping), n));
    reduced += n.camera;
    reduced.diagonal() += damping * n.camera.diagonal();
    reduced -= n.cross * pose.by_camera;
    right += n.camera_gradient - n.cross * pose.alone;
  }
  for (std::size_t k = 0; k < kCameraParameters; ++k) {
    if (!bundle.free[k]) reduced(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(k)) = 1.0;
  }
  Step step;
  // Unit diagonal first: focal lengths and distortion coefficients differ by many powers of ten.
  const CameraVector scale = reduced.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  const CameraMatrix scaled = scale.asDiagonal() * reduced * scale.asDiagonal();
  step.camera = scale.asDiagonal() * solve_symmetric(scaled, scale.asDiagonal() * right);
  step.poses.reserve(normals.size());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const ViewNormals& n = normals[v];
    step.poses.push_back(poses[v].alone - poses[v].by_camera * step.camera);
    step.predicted_px2 += step.camera.dot(n.camera_gradient) + step.poses.back().dot(n.pose_gradient);
  }
  return step;
}

double sum_of_squares_px2(std::span<const BoardView* const> views, const CameraVector& parameters,
                          const std::vector<Pose>& poses) {
  double sum = 0.0;
  for (std::size_t v = 0; v < views.size(); ++v) sum += view_sum_of_squares_px2(*views[v], parameters, poses[v]);
  return sum;
}

void store_information(const std::vector<ViewNormals>& normals, CameraBundle& bundle) {
  bundle.information.setZero();
  bundle.view_information.clear();
  bundle.view_score.clear();
  for (const ViewNormals& n : normals) {
    const EliminatedPose pose = eliminate_pose(n.pose, n);
    bundle.view_information.push_back(n.camera - n.cross * pose.by_camera);
    bundle.view_score.push_back(n.camera_gradient - n.cross * pose.alone);
    bundle.information += bundle.view_information.back();
  }
}

}  // namespace

double view_sum_of_squares_px2(const BoardView& view, const CameraVector& parameters, const Pose& T_camera_board) {
  double sum = 0.0;
  Eigen::Vector2d pixel;
  for (std::size_t i = 0; i < view.corner_px.size(); ++i) {
    if (!project_pixel(parameters, T_camera_board * view.p_board_m[i], pixel)) return kInfinity;
    sum += (view.corner_px[i] - pixel).squaredNorm();
  }
  return sum;
}

void refine_bundle(std::span<const BoardView* const> views, int most_iterations, CameraBundle& bundle) {
  // A step that gains less than this share of the sum of squares moves no parameter by a visible part of its error.
  constexpr double kLeastGain = 1e-12;
  constexpr double kMostDamping = 1e12;
  std::vector<ViewNormals> normals(views.size());
  const auto linearise = [&] {
    for (std::size_t v = 0; v < views.size(); ++v) normals[v] = normals_of(*views[v], bundle, bundle.T_camera_board[v]);
  };
  double damping = 1e-3;
  bundle.sum_of_squares_px2 = sum_of_squares_px2(views, bundle.parameters, bundle.T_camera_board);
  bundle.converged = false;
  linearise();
  for (bundle.iterations = 0; bundle.iterations < most_iterations; ++bundle.iterations) {
    const Step step = solve_step(normals, bundle, damping);
    CameraVector parameters = bundle.parameters + step.camera;
    std::vector<Pose> poses = bundle.T_camera_board;
    for (std::size_t v = 0; v < poses.size(); ++v) {
      poses[v].rotation = (exp_rotation(step.poses[v].head<3>()) * poses[v].rotation).normalized();
      poses[v].translation_m += step.poses[v].tail<3>();
    }
    const double sum = sum_of_squares_px2(views, parameters, poses);
    if (sum < bundle.sum_of_squares_px2) {
      const double gain = bundle.sum_of_squares_px2 - sum;
      bundle.converged = gain <= kLeastGain * bundle.sum_of_squares_px2;
      bundle.parameters = parameters;
      bundle.T_camera_board = std::move(poses);
      bundle.sum_of_squares_px2 = sum;
      linearise();
      damping *= 0.1;
    } else {
      // Rounding hides the gain of a step that is small enough.
      bundle.converged = step.predicted_px2 <= kLeastGain * bundle.sum_of_squares_px2;
      damping *= 10.0;
    }
    if (bundle.converged || damping > kMostDamping) break;
  }
  store_information(normals, bundle);
}

}  // namespace asperity
