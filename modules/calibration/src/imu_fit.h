#pragma once

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "imu_motion.h"

namespace asperity {

// What is measured, each kind with a noise of its own; the last two are the motion's own smoothness.
struct ImuNoise {
  static constexpr std::size_t kPosition = 0, kRotation = 3, kAccelerometer = 6, kGyroscope = 7, kTurning = 8,
                               kMoving = 9, kKinds = 10;
  std::array<double, kKinds> sigma{};
};

// The least squares of calibrate_imu at one linearisation after another.
class ImuFit {
 public:
  ImuFit(SensorSeries accelerometer, SensorSeries gyroscope, PoseSeries poses, ImuMotion motion, ImuParameters start,
         const ImuConfig& config);

  // Steps until they are small against their standard errors, the noise taken as the residuals show it. False where the
  // system is singular or the steps do not become small.
  bool run();

  // Leaves out poses more than `sigmas` standard deviations off; their number.
  std::size_t drop_outliers(double sigmas);

  const ImuParameters& parameters() const { return parameters_; }
  const ImuNoise& noise() const { return noise_; }
  const PoseSeries& poses() const { return poses_; }
  const ImuMotion& motion() const { return motion_; }
  const Eigen::MatrixXd& covariance() const { return covariance_; }

  // Of the parameters: variance between the recording's seconds over that within; and its own standard error.
  struct Dispersion {
    double value = 1.0, error = 0.0;
  };
  Dispersion dispersion() const;

 private:
  using Local = Eigen::Matrix<double, 3, ArrowSystem::kLocal>;
  using Global = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, ImuParameters::kWithGyro>;
  // Three rows of one kind (of three kinds, one a row, for a pose): residual, its slopes.
  struct Rows {
    double t_s = 0.0;
    std::array<std::size_t, 3> kind;
    Eigen::Index first_point = 0;
    Eigen::Vector3d residual;
    Local local;
    Global global;
  };
  void visit(const std::function<void(const Rows&)>& use) const;
  void visit_pose(std::size_t i, Rows& rows, const std::function<void(const Rows&)>& use) const;
  void whiten(Rows& rows) const;
  ArrowSystem assemble() const;
  void update_noise(const ArrowSystem& system);
  void step(const Eigen::VectorXd& points, const Eigen::VectorXd& parameters);
  bool has_gyro() const { return !gyroscope_.t_s.empty(); }
  Eigen::Index count() const { return has_gyro() ? ImuParameters::kWithGyro : ImuParameters::kWithoutGyro; }
  // Standard deviations of what is known beforehand; infinite for what is not.
  Eigen::VectorXd prior_sigma() const;

  SensorSeries accelerometer_, gyroscope_;
  PoseSeries poses_;
  ImuMotion motion_;
  ImuParameters parameters_;
  ImuParameters given_;  // at the start
  double gravity_sigma_;
  ImuNoise noise_;
  Eigen::MatrixXd covariance_, taken_up_;
};

}  // namespace asperity
