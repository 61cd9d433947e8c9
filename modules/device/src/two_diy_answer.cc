#include "two_diy_answer.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace asperity {

namespace {

constexpr int kRefusedUntilFault = 5;
constexpr double kMost_deg = 3600.0;
constexpr double kFastest_deg_per_s = 3600.0, kLeastJump_deg = 5.0;

static_assert(std::endian::native == std::endian::little, "the board's floats are little-endian");

}  // namespace

TwoDiyAnswers::Kind TwoDiyAnswers::take(std::span<const unsigned char, kTwoDiyAnswer_bytes> answer, double t_s,
                                        bool is_current) {
  float degrees[2];
  std::memcpy(degrees, answer.data() + 1, sizeof degrees);
  const Eigen::Vector2d theta_deg(static_cast<double>(degrees[0]), static_cast<double>(degrees[1]));
  if (!is_believable(answer[0], theta_deg, t_s)) {
    return ++refused_ >= kRefusedUntilFault ? Kind::kFault : Kind::kRefused;
  }
  refused_ = 0;
  if (!is_current) return Kind::kBelieved;
  theta_deg_ = theta_deg;
  theta_at_s_ = t_s;
  return Kind::kBelieved;
}

bool TwoDiyAnswers::is_believable(unsigned char id, const Eigen::Vector2d& theta_deg, double t_s) const {
  // One by one: what a vector's maximum is where one of them is not a number is open.
  const auto within = [](const Eigen::Vector2d& angles, double most) {
    return std::abs(angles.x()) <= most && std::abs(angles.y()) <= most;
  };
  if (id != id_ || !within(theta_deg, kMost_deg)) return false;
  return !theta_deg_ || within(theta_deg - *theta_deg_, kFastest_deg_per_s * (t_s - theta_at_s_) + kLeastJump_deg);
}

}  // namespace asperity
