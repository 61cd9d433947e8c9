#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

namespace asperity {

// An answer of the 2diy's board: its id, then the two motors' angles in degrees, each a little-endian float.
inline constexpr std::size_t kTwoDiyAnswer_bytes = 1 + 2 * sizeof(float);

// Which of a board's answers are believed. They are framed by the id alone: the tail of a late one before the next may
// look like one, with other angles. So an answer is refused that has another id, an angle that is not finite or beyond
// ten rotations, or a jump that no hand makes (3600°/s, and 5° of noise).
class TwoDiyAnswers {
 public:
  enum class Kind { kBelieved, kRefused, kFault };  // kFault: the fifth one refused in succession

  explicit TwoDiyAnswers(unsigned char id) : id_(id) {}

  // `t_s`: when it came, on any clock that rises. One that is not current is judged as the others are, but what comes
  // next is not compared with it.
  Kind take(std::span<const unsigned char, kTwoDiyAnswer_bytes> answer, double t_s, bool is_current = true);

  // Of the last current one believed.
  const std::optional<Eigen::Vector2d>& theta_deg() const { return theta_deg_; }

 private:
  bool is_believable(unsigned char id, const Eigen::Vector2d& theta_deg, double t_s) const;

  unsigned char id_;
  int refused_ = 0;  // one after another
  std::optional<Eigen::Vector2d> theta_deg_;
  double theta_at_s_ = 0.0;
};

}  // namespace asperity
