#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// The integral of the straight lines between samples over time (s), from the first sample on.
class RunningIntegral {
 public:
  RunningIntegral(const std::vector<std::int64_t>& t_ns, const std::vector<Eigen::Vector3d>& value);

  // nullopt outside the samples.
  std::optional<Eigen::Vector3d> to(std::int64_t t_ns) const;
  // Over an interval, nullopt if it is not within the samples.
  std::optional<Eigen::Vector3d> between(std::int64_t from_ns, std::int64_t to_ns) const;

 private:
  const std::vector<std::int64_t>& t_ns_;
  const std::vector<Eigen::Vector3d>& value_;
  std::vector<Eigen::Vector3d> sum_;
};

}  // namespace asperity
