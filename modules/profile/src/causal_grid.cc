#include "asperity/profile/causal_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::int64_t kMostHoles = 400'000;  // points; a wider hole begins the numbering anew there

}  // namespace

CausalGrid::CausalGrid(double spacing_m, double max_hole_m) : spacing_m_(spacing_m), max_hole_m_(max_hole_m) {
  if (!(spacing_m > 0.0)) throw Error("profile: spacing " + number_text(spacing_m) + " m");
}

void CausalGrid::fill_holes(std::int64_t up_to_cell, std::vector<Sample>& out) {
  if (any_cell_ && up_to_cell - next_cell_ < kMostHoles) {
    for (; next_cell_ < up_to_cell; ++next_cell_) {
      Sample hole;
      hole.t_ns = last_ns_;
      hole.s_m = static_cast<double>(next_cell_) * spacing_m_;
      hole.height_m = hole.sigma_m = hole.force_N = hole.speed_mps = kNan;
      out.push_back(hole);
    }
  }
  next_cell_ = std::max(next_cell_, up_to_cell);
}

// Parts come in order; a cell with all of its parts is a point.
void CausalGrid::add_part(std::int64_t number, const Knot& at, std::vector<Sample>& out) {
  // Cell k holds the parts 4k - 2 to 4k + 1.
  const auto cell = static_cast<std::int64_t>(std::floor((static_cast<double>(number) + 0.5 * kParts) / kParts));
  const std::int64_t part = number + kParts / 2 - cell * kParts;
  if (part == 0) {
    cell_sum_ = {};
    in_cell_ = 0;
  }
  if (part != in_cell_ || (any_cell_ && cell < next_cell_)) return;  // it began before this run, or is known already
  cell_sum_.t += at.t;
  cell_sum_.height += at.height;
  cell_sum_.sigma += at.sigma;
  cell_sum_.force += at.force;
  cell_sum_.speed += at.speed;
  if (++in_cell_ < kParts) return;
  fill_holes(cell, out);
  const double w = 1.0 / kParts;
  Sample point;
  point.t_ns = origin_ns_ + std::llround(w * cell_sum_.t * 1e9);
  last_ns_ = point.t_ns;
  point.s_m = static_cast<double>(cell) * spacing_m_;
  point.height_m = w * cell_sum_.height;
  point.sigma_m = w * cell_sum_.sigma;
  point.force_N = w * cell_sum_.force;
  point.speed_mps = w * cell_sum_.speed;
  out.push_back(point);
  any_cell_ = true;
  next_cell_ = cell + 1;
}

// The parts between the knots `from` and from + 1.
void CausalGrid::interpolate(std::size_t from, std::vector<Sample>& out) {
  const Knot& a = knots_[from];
  const Knot& b = knots_[from + 1];
  const double step = b.s - a.s;
  const auto slope = [&](std::size_t i) {
    const Knot& at = knots_[i];
    const bool has_before = i > 0;
    const bool has_after = i + 1 < knots_.size();
    if (!has_before) return (knots_[i + 1].height - at.height) / (knots_[i + 1].s - at.s);
    const double before = (at.height - knots_[i - 1].height) / (at.s - knots_[i - 1].s);
    if (!has_after) return before;
    const double h0 = at.s - knots_[i - 1].s, h1 = knots_[i + 1].s - at.s;
    const double after = (knots_[i + 1].height - at.height) / h1;
    return (h1 * before + h0 * after) / (h0 + h1);  // of the parabola through the three
  };
  const double ma = slope(from), mb = slope(from + 1);
  const double part_m = spacing_m_ / kParts;
  while (true) {
    const double s = (static_cast<double>(next_part_) + 0.5) * part_m;
    if (s >= b.s) return;
    const std::int64_t number = next_part_++;
    if (s < a.s) continue;
    const double u = (s - a.s) / step, v = 1.0 - u;
    Knot at;
    at.height =
        v * v * ((1.0 + 2.0 * u) * a.height + u * step * ma) + u * u * ((1.0 + 2.0 * v) * b.height - v * step * mb);
    at.t = v * a.t + u * b.t;
    at.sigma = v * a.sigma + u * b.sigma;
    at.force = v * a.force + u * b.force;
    at.speed = v * a.speed + u * b.speed;
    add_part(number, at, out);
  }
}

void CausalGrid::add_knot(const Knot& knot, std::vector<Sample>& out) {
  if (!knots_.empty() && knot.s - knots_.back().s > max_hole_m_) {
    if (knots_.size() >= 2) interpolate(knots_.size() - 2, out);
    knots_.clear();
  }
  if (knots_.empty()) {
    next_part_ = static_cast<std::int64_t>(std::floor(kParts * knot.s / spacing_m_));
    in_cell_ = 0;
  }
  knots_.push_back(knot);
  if (knots_.size() > 4) knots_.erase(knots_.begin());
  if (knots_.size() >= 3) interpolate(knots_.size() - 3, out);
}

void CausalGrid::close_knot(std::vector<Sample>& out) {
  if (in_sum_ == 0) return;
  const double w = 1.0 / in_sum_;
  add_knot({w * sum_.s, w * sum_.t, w * sum_.height, w * sum_.sigma, w * sum_.force, w * sum_.speed}, out);
  sum_ = {};
  in_sum_ = 0;
}

void CausalGrid::push(const Sample& sample, std::vector<Sample>& out) {
  if (!std::isfinite(sample.s_m) || !std::isfinite(sample.height_m)) return;
  if (!any_) {
    any_ = true;
    origin_ns_ = sample.t_ns;
  }
  const auto quarter = static_cast<std::int64_t>(std::floor(kParts * sample.s_m / spacing_m_));
  const bool going = in_sum_ > 0 || !knots_.empty();
  if (going && quarter < quarter_) return;
  if (going && quarter > quarter_) close_knot(out);
  if (going && in_sum_ == 0 && quarter == quarter_) return;  // that quarter has its knot
  quarter_ = quarter;
  sum_.s += sample.s_m;
  sum_.t += static_cast<double>(sample.t_ns - origin_ns_) * 1e-9;
  sum_.height += sample.height_m;
  sum_.sigma += sample.sigma_m;
  sum_.force += sample.force_N;
  sum_.speed += sample.speed_mps;
  ++in_sum_;
}

void CausalGrid::cut(std::vector<Sample>& out) {
  close_knot(out);
  if (knots_.size() >= 2) interpolate(knots_.size() - 2, out);
  knots_.clear();
  in_cell_ = 0;
}

}  // namespace asperity
