#include "asperity/pipeline/read_path.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::uint64_t kLargestFile_bytes = 1 << 30;
constexpr double kFarthest_m = 1e6;
constexpr std::int64_t kFarthest_ns = std::int64_t{1} << 61;  // differences fit

// The places of all of `names`, or nothing: a file that has only some of them is at fault.
template <std::size_t N>
std::optional<std::array<std::size_t, N>> find_all(const CsvReader& csv, const std::array<std::string_view, N>& names) {
  std::array<std::size_t, N> places{};
  std::size_t found = 0;
  for (const std::string_view name : names) found += csv.find(name) ? 1 : 0;
  if (found == 0) return std::nullopt;
  for (std::size_t i = 0; i < N; ++i) places[i] = csv.require(names[i]);
  return places;
}

Eigen::Vector3d vector_at(const CsvReader& csv, const std::array<std::size_t, 3>& places) {
  return {csv.number(places[0]), csv.number(places[1]), csv.number(places[2])};
}

Eigen::Quaterniond rotation_at(const CsvReader& csv, const std::array<std::size_t, 4>& places) {
  const Eigen::Quaterniond q(csv.number(places[0]), csv.number(places[1]), csv.number(places[2]),
                             csv.number(places[3]));
  constexpr double kNormTolerance = 1e-3;
  if (!(std::abs(q.norm() - 1.0) < kNormTolerance)) csv.fail(places[0], "the quaternion is not of unit length");
  return q.normalized();
}

// The standard deviation of the positions, per world axis or one for all: trajectory.csv has both.
class StatedError {
 public:
  explicit StatedError(const CsvReader& csv)
      : of_axes_(find_all<3>(csv, {"sigma_x_m", "sigma_y_m", "sigma_z_m"})), of_all_(csv.find("sigma_m")) {}

  bool is_stated() const { return of_axes_ || of_all_; }
  // Of the row; nan where its cell is.
  Eigen::Vector3d sigma_m(const CsvReader& csv) const {
    const std::array<std::size_t, 3> places =
        of_axes_ ? *of_axes_ : std::array<std::size_t, 3>{*of_all_, *of_all_, *of_all_};
    const Eigen::Vector3d out = vector_at(csv, places);
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = out[static_cast<Eigen::Index>(k)];
      if (value < 0.0 || value > kFarthest_m)
        csv.fail(places[k], "'" + printable(csv.cell(places[k])) + "' is not a standard deviation in metres");
    }
    return out;
  }

 private:
  std::optional<std::array<std::size_t, 3>> of_axes_;
  std::optional<std::size_t> of_all_;
};

}  // namespace

PathFile read_path(const std::filesystem::path& file) {
  return parse_path(read_file(file, kLargestFile_bytes), printable(file.string()));
}

PathFile parse_path(std::string_view text, const std::string& name) {
  CsvReader csv(text, name);
  csv.accept_unterminated();
  const std::array<std::size_t, 3> position{csv.require("px_m"), csv.require("py_m"), csv.require("pz_m")};
  const auto time = csv.find("t_ns");
  const auto rotation = find_all<4>(csv, {"qw", "qx", "qy", "qz"});
  const auto velocity = find_all<3>(csv, {"vx_mps", "vy_mps", "vz_mps"});
  const auto force = csv.find("force_N");
  const StatedError error(csv);

  PathFile out;
  out.timed = time.has_value();
  out.oriented = rotation.has_value();
  TipMotion& motion = out.motion;
  std::size_t passed_over = 0, without_error = 0;
  while (csv.next()) {
    const Eigen::Vector3d p_m = vector_at(csv, position);
    if (p_m.array().isNaN().any()) {
      ++passed_over;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(std::abs(p_m[static_cast<Eigen::Index>(k)]) <= kFarthest_m)) {
        csv.fail(position[k], "'" + printable(csv.cell(position[k])) + "' is not a position in metres");
      }
    }
    const std::int64_t t_ns = time ? csv.integer(*time) : static_cast<std::int64_t>(motion.size());
    if (t_ns < -kFarthest_ns || t_ns > kFarthest_ns) csv.fail(*time, std::to_string(t_ns) + " ns is not a valid time");
    if (!motion.t_ns.empty() && t_ns <= motion.t_ns.back()) csv.fail(*time, "time does not rise");
    motion.t_ns.push_back(t_ns);
    motion.p_world_tip_m.push_back(p_m);
    motion.q_world_marker.push_back(rotation ? rotation_at(csv, *rotation) : Eigen::Quaterniond::Identity());
    motion.v_world_tip_mps.push_back(velocity ? vector_at(csv, *velocity) : Eigen::Vector3d::Zero());
    if (motion.v_world_tip_mps.back().array().isInf().any()) csv.fail((*velocity)[0], "the velocity is not finite");
    if (error.is_stated()) {
      const Eigen::Vector3d sigma_m = error.sigma_m(csv);
      without_error += sigma_m.array().isNaN().any() || sigma_m.isZero(0.0) ? 1 : 0;
      motion.cov_world_tip_m2.push_back(sigma_m.cwiseAbs2().asDiagonal().toDenseMatrix());
    }
    if (force) {
      motion.force_N.push_back(csv.empty(*force) ? std::numeric_limits<double>::quiet_NaN() : csv.number(*force));
      if (std::isinf(motion.force_N.back())) csv.fail(*force, "the force is not finite");
    }
  }
  if (motion.size() == 0) throw Error(name + ": no row with a position");
  // An error of some of the rows is none of the path.
  if (without_error > 0) {
    motion.cov_world_tip_m2.clear();
    if (without_error < motion.size()) {
      out.problems.push_back({"no_error",
                              "rows without a standard deviation: the path counts as one without stated errors",
                              without_error});
    }
  }
  if (passed_over > 0) out.problems.push_back({"no_position", "rows without a position were skipped", passed_over});
  return out;
}

}  // namespace asperity
