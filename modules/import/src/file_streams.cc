#include "asperity/import/file_streams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <Eigen/LU>
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/import/stated_setting.h"
#include "lost_poses.h"
#include "row_times.h"
#include "split_cells.h"

namespace asperity {

namespace {

const MappedColumn& needed(const ImportTable& in, const std::string& meaning) {
  if (const MappedColumn* column = find_meaning(in.map, meaning)) return *column;
  throw Error(fmt::format("{}: no column is {} ({}): name it, as {}=NAME[UNIT] or {}=#4[UNIT]", in.table.file, meaning,
                          role_name(in.role), meaning, meaning));
}

// A column's values in SI units; nan where there is none. Text is an error.
std::vector<double> si_values(const ImportTable& in, const std::string& meaning) {
  const MappedColumn& mapped = needed(in, meaning);
  const DelimitedColumn& column = in.table.columns[mapped.column];
  if (column.has_text) {
    for (std::size_t row = 0; row < in.table.rows(); ++row) {
      if (std::isnan(column.values[row]) && !is_missing_cell(in.table.cell(row, mapped.column))) {
        fail_at(in.table, row, mapped.column, "is not a number");
      }
    }
  }
  const ImportUnit unit = parse_import_unit(mapped.unit, quantity_of(meaning), in.table.file);
  // Division by an exact power of ten is correctly rounded where multiplication by 1e-3 is not.
  const double inverse = std::round(1.0 / unit.factor);
  const bool divide = unit.factor < 1.0 && std::abs(inverse * unit.factor - 1.0) < 1e-15;
  const double sign = mapped.negative ? -1.0 : 1.0;
  std::vector<double> out = column.values;
  for (std::size_t row = 0; row < out.size(); ++row) {
    out[row] = sign * (divide ? out[row] / inverse : out[row] * unit.factor);
    constexpr double kMost = 1e9;  // metres, radians, m/s², N: what no sensor measures
    if (std::abs(out[row]) > kMost) fail_at(in.table, row, mapped.column, "is too large");
  }
  return out;
}

void note_rows(const ImportTable& in, const char* kind, std::size_t count, const std::string& message,
               Problems& problems) {
  if (count == 0) return;
  problems.push_back(
      {kind, fmt::format("{}: {} {} {}", in.table.file, count, count == 1 ? "row" : "rows", message), count});
}

// Rows that were put in order and then are hours apart are of several clocks or recordings.
void refuse_far_apart(const ImportTable& in, const std::vector<std::optional<std::int64_t>>& t_ns,
                      const std::vector<std::size_t>& rows, std::size_t first_line) {
  constexpr double kHour_s = 3600.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double gap_s = 1e-9 * static_cast<double>(*t_ns[rows[i]] - *t_ns[rows[i - 1]]);
    if (gap_s <= kHour_s) continue;
    throw Error(
        fmt::format("{}:{}: a time before that of the row above, and put in order the times have a gap of {:.4g} "
                    "h: split the file where its clock begins again, or state the unit of the time",
                    in.table.file, first_line, gap_s / kHour_s));
  }
}

// The same values at the same time are one row that was written twice.
bool is_same_row(const ImportTable& in, std::size_t a, std::size_t b) {
  return std::all_of(in.map.begin(), in.map.end(), [&](const MappedColumn& column) {
    const std::vector<double>& values = in.table.columns[column.column].values;
    return group_of(column.meaning) == ColumnGroup::kTime || values[a] == values[b];
  });
}

// Rows a second by a straight line through the times: coarse steps do not bend it.
double mean_row_rate_Hz(const std::vector<std::optional<std::int64_t>>& t_ns, const std::vector<std::size_t>& rows) {
  const double n = static_cast<double>(rows.size());
  double covariance = 0.0, mean_s = 0.0;
  for (const std::size_t row : rows) mean_s += 1e-9 * static_cast<double>(*t_ns[row] - *t_ns[rows.front()]) / n;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    covariance += (static_cast<double>(i) - 0.5 * (n - 1.0)) *
                  (1e-9 * static_cast<double>(*t_ns[rows[i]] - *t_ns[rows.front()]) - mean_s);
  }
  return covariance > 0.0 ? n * (n * n - 1.0) / 12.0 / covariance : 0.0;
}

// Times of which many rows share one are those of a clock too coarse for its rows.
void refuse_coarse_times(const ImportTable& in, const std::vector<std::optional<std::int64_t>>& t_ns,
                         const std::vector<std::size_t>& rows) {
  std::size_t shared = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (*t_ns[rows[i]] == *t_ns[rows[i - 1]] && !is_same_row(in, rows[i], rows[i - 1])) ++shared;
  }
  constexpr double kMostShared = 0.01;
  if (static_cast<double>(shared) <= kMostShared * static_cast<double>(rows.size())) return;
  const double rate_Hz = mean_row_rate_Hz(t_ns, rows);
  throw UnstatedSetting(
      fmt::format("{}: {} of {} rows of the {} have the time of an earlier one: the clock is too coarse for its rate; "
                  "state the rate instead of the times",
                  in.table.file, shared, rows.size(), role_name(in.role)),
      {fmt::format("mapping.{}.rate_Hz", setting_name(in.role)), fmt::format("{:.6g}", rate_Hz)});
}

// The rows to keep, in order of time: those for which `is_usable(row)` and that have a time, the first of equal times.
// `known` of the others are reported already.
template <class Usable>
std::vector<std::size_t> ordered_rows(const ImportTable& in, const std::vector<std::optional<std::int64_t>>& t_ns,
                                      const Usable& is_usable, Problems& problems, std::size_t known = 0) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < t_ns.size(); ++row) {
    if (t_ns[row] && is_usable(row)) rows.push_back(row);
  }
  note_rows(in, "missing_values", t_ns.size() - rows.size() - known, "without all values were left out", problems);
  const auto earlier = [&](std::size_t a, std::size_t b) { return *t_ns[a] < *t_ns[b]; };
  std::size_t backwards = 0, first = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (!(*t_ns[rows[i]] < *t_ns[rows[i - 1]])) continue;
    if (backwards++ == 0) first = in.table.row_line[rows[i]];
  }
  note_rows(
      in, "time_backwards", backwards,
      fmt::format("with a time before that of the row above, first in line {}; the rows were put in order", first),
      problems);
  if (backwards > 0) {
    std::stable_sort(rows.begin(), rows.end(), earlier);
    refuse_far_apart(in, t_ns, rows, first);
  }
  refuse_coarse_times(in, t_ns, rows);
  const std::size_t all = rows.size();
  rows.erase(std::unique(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return *t_ns[a] == *t_ns[b]; }),
             rows.end());
  note_rows(in, "duplicate_time", all - rows.size(), "with the time of an earlier one were left out", problems);
  if (rows.empty()) {
    throw Error(fmt::format("{}: no row has a time and all values of the {}", in.table.file, role_name(in.role)));
  }
  return rows;
}

// The rotations of all rows; nullopt: missing. Counts those that are not rotations.
class RotationReader {
 public:
  RotationReader(const ImportTable& in, const MappingConfig& config) : in_(in) {
    const auto take = [&](std::initializer_list<const char*> meanings) {
      for (const char* meaning : meanings) columns_.push_back(si_values(in, meaning));
    };
    if (find_meaning(in.map, "qw") != nullptr) {
      kind_ = 'q';
      take({"qw", "qx", "qy", "qz"});
    } else if (find_meaning(in.map, "m11") != nullptr) {
      kind_ = 'm';
      take({"m11", "m12", "m13", "m21", "m22", "m23", "m31", "m32", "m33"});
    } else if (find_meaning(in.map, "vx") != nullptr) {
      kind_ = 'v';
      take({"vx", "vy", "vz"});
    } else if (find_meaning(in.map, "rx") != nullptr) {
      kind_ = 'r';
      take({"rx", "ry", "rz"});
      order_ = config.euler.empty() ? in.preset.euler : config.euler;
      axes_ = config.euler_axes;
      if (order_.empty()) {
        throw UnstatedSetting(in.table.file + ": the order of the Euler angles is not known: state it",
                              {"mapping.euler", "zyx"});
      }
    } else {
      throw Error(in.table.file + ": no columns are a rotation: qw qx qy qz, rx ry rz, vx vy vz or m11 … m33");
    }
    check_lengths();
  }

  std::optional<Eigen::Quaterniond> rotation(std::size_t row) const {
    const auto at = [&](std::size_t i) { return columns_[i][row]; };
    for (const auto& column : columns_) {
      if (std::isnan(column[row])) return std::nullopt;
    }
    if (kind_ == 'q') {
      const Eigen::Quaterniond q(at(0), at(1), at(2), at(3));
      return is_unit_length(q.norm()) ? std::optional(q.normalized()) : std::nullopt;
    }
    if (kind_ == 'v') return exp_rotation({at(0), at(1), at(2)});
    if (kind_ == 'r') return euler_rotation({at(0), at(1), at(2)}, order_, axes_);
    Eigen::Matrix3d m;
    for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = at(static_cast<std::size_t>(i));
    constexpr double kRounding = 0.02;
    if ((m * m.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > kRounding || m.determinant() < 0.0) {
      return std::nullopt;
    }
    return Eigen::Quaterniond(m).normalized();
  }

 private:
  static bool is_unit_length(double length) {
    constexpr double kTolerance = 0.05;
    return std::abs(length - 1.0) <= kTolerance;
  }

  void check_lengths() const {
    std::size_t whole = 0, bad = 0;
    for (std::size_t row = 0; row < in_.table.rows(); ++row) {
      const bool missing =
          std::any_of(columns_.begin(), columns_.end(), [&](const auto& c) { return std::isnan(c[row]); });
      if (missing) continue;
      ++whole;
      if (!rotation(row)) ++bad;
    }
    if (bad * 2 <= whole) return;
    const std::size_t first = find_meaning(in_.map, kind_ == 'q' ? "qw" : "m11")->column;
    throw Error(fmt::format("{}: {} of {} rows from {} on do not hold a {}: other columns, or another order, are meant",
                            in_.table.file, bad, whole, in_.table.describe(first),
                            kind_ == 'q' ? "quaternion of length 1" : "rotation matrix"));
  }

  const ImportTable& in_;
  std::vector<std::vector<double>> columns_;
  char kind_ = 'q';
  std::string order_;
  EulerAxes axes_ = EulerAxes::kIntrinsic;
};

}  // namespace

VectorStream read_vectors(const ImportTable& in, char letter, Problems& problems) {
  std::array<std::vector<double>, 3> values;
  for (std::size_t i = 0; i < 3; ++i) values[i] = si_values(in, std::string(1, letter) + "xyz"[i]);
  const auto t_ns = read_row_times(in, problems);
  const auto usable = [&](std::size_t row) {
    return !std::isnan(values[0][row]) && !std::isnan(values[1][row]) && !std::isnan(values[2][row]);
  };
  VectorStream out;
  for (const std::size_t row : ordered_rows(in, t_ns, usable, problems)) {
    out.t_ns.push_back(*t_ns[row]);
    out.value.emplace_back(values[0][row], values[1][row], values[2][row]);
  }
  return out;
}

ScalarStream read_scalars(const ImportTable& in, const char* meaning, Problems& problems) {
  const std::vector<double> values = si_values(in, meaning);
  const auto t_ns = read_row_times(in, problems);
  ScalarStream out;
  for (const std::size_t row : ordered_rows(
           in, t_ns, [&](std::size_t i) { return !std::isnan(values[i]); }, problems)) {
    out.t_ns.push_back(*t_ns[row]);
    out.value.push_back(values[row]);
  }
  return out;
}

PoseStream read_poses(const ImportTable& in, const MappingConfig& config, Problems& problems) {
  std::array<std::vector<double>, 3> position;
  for (std::size_t i = 0; i < 3; ++i) position[i] = si_values(in, std::string("p") + "xyz"[i]);
  const RotationReader rotations(in, config);
  const auto t_ns = read_row_times(in, problems);
  std::vector<std::optional<Eigen::Quaterniond>> q(in.table.rows());
  for (std::size_t row = 0; row < q.size(); ++row) q[row] = rotations.rotation(row);
  const std::size_t lost = leave_out_zero_poses(in, position, q, problems);
  const auto usable = [&](std::size_t row) {
    return q[row] && !std::isnan(position[0][row]) && !std::isnan(position[1][row]) && !std::isnan(position[2][row]);
  };
  PoseStream out;
  for (const std::size_t row : ordered_rows(in, t_ns, usable, problems, lost)) {
    out.t_ns.push_back(*t_ns[row]);
    out.T_world_body.push_back({config.invert_rotation ? q[row]->conjugate() : *q[row],
                                {position[0][row], position[1][row], position[2][row]}});
  }
  return out;
}

Eigen::Quaterniond euler_rotation(const Eigen::Vector3d& angles_rad, const std::string& order, EulerAxes axes) {
  std::string sorted = order;
  std::sort(sorted.begin(), sorted.end());
  if (sorted != "xyz")
    throw Error("the order of Euler angles '" + printable(order) + "' is not one of x, y, z each once");
  Eigen::Quaterniond out = Eigen::Quaterniond::Identity();
  for (const char axis : order) {
    const int i = axis - 'x';
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angles_rad[i], Eigen::Vector3d::Unit(i)));
    out = axes == EulerAxes::kIntrinsic ? out * turn : turn * out;
  }
  return out;
}

}  // namespace asperity
