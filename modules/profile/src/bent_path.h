#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// A profile's path laid out flat (unroll_path.h), and what straight ribs look like along it. Ribs whose normal makes
// an angle with the chord, of the tangent t, are crossed at x + t y, x along the chord and y to its left; that is
// scaled so that it rises by the profile's length and is called the ribs' coordinate. Where the path bends, equal
// periods of it are unequal along the path.
class BentPath {
 public:
  // The points of the profile, m; empty for a path of which nothing is known.
  BentPath(std::span<const Eigen::Vector2d> unrolled_m, double spacing_m);

  // Whether its bend is more than 1/50 of its length. A straighter one has one hypothesis.
  bool bends() const { return bends_; }

  // By how many tangents apart two directions of ribs of this length look unlike: half a period over the whole bend.
  double step_of_direction(double pitch_m) const { return 0.5 * pitch_m / bend_m_; }

  // RMS of what bends, about its straight line, m.
  double bend_rms_m() const { return bend_rms_m_; }

  // The path's end from its beginning, and its points to the left of that line, m.
  double chord_m() const { return x_m_.empty() ? 0.0 : x_m_.back() - x_m_.front(); }
  const std::vector<double>& left_m() const { return y_m_; }

  // Whether ribs of this direction are crossed one way only, nowhere at less than 0.3 of their mean rate.
  bool crosses(double tangent) const;

  // The heights, m, nan in gaps, evenly along the ribs' coordinate: as many, as far apart.
  std::vector<double> straightened(std::span<const double> height_m, double tangent) const;

  // RMS of the local period along the path about its mean, relative to the mean.
  double spread_of_period(double tangent) const;

  // The period across the ribs over that of their coordinate.
  double across_over_along(double tangent) const;

  // By how much the period across the ribs changes with their tangent, relative, where the heights' waves are as many.
  double change_of_across(double tangent) const;

 private:
  double coordinate(std::size_t i, double tangent) const { return x_m_[i] + tangent * y_m_[i]; }

  double spacing_m_ = 0.0;
  std::vector<double> x_m_, y_m_;
  double bend_m_ = 0.0, bend_rms_m_ = 0.0, slope_ = 0.0;  // slope: of the straight line through the path
  bool bends_ = false;
};

}  // namespace asperity
