#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// Heights at evenly spaced points, row by row; nan: not known. A profile is one row, along `column_spacing_m`.
struct HeightGridShape {
  std::size_t rows = 1;
  std::size_t columns = 0;
  double row_spacing_m = 1.0;  // from row to row; of one row: not used
  double column_spacing_m = 1.0;
};

// The surface under a ball, as far as the ball's positions show it.
struct TipErosion {
  std::vector<double> surface_m;  // nan where the tip's height is
  std::vector<char> touched;      // 1: the tip was in contact here, and nowhere else at the same time
};

// Grey-scale morphology with a ball of radius R (Sternberg 1986; Villarrubia, J. Res. NIST 102, 1997). The tip's height
// is the lowest point of the ball. With b(u) = √(R² − |u|²) − R on |u| ≤ R the measured heights are the dilation
// d(x) = max z(x + u) + b(u) of the surface z, and the erosion is
//
//   e(x) = min over |u| ≤ R of d(x + u) − b(u),      z ≤ e ≤ d
//
// The ball is read at the offsets between the grid's points. So erosion and dilation are adjoint on the grid: the
// dilation of e is d again if d is the dilation of any heights at the grid's points, to the rounding of one addition.
// Against a surface between the points e is too high by at most a²/8R near level contact, a the spacing.
//
// `touched` is Villarrubia's criterion: a point of e is the surface's if a position of the ball touches e in this point
// alone; points within `resolution_m` of one another (along rows and along columns) count as one. At the other points
// the surface may be lower without any change of d. What is beyond the ends or in a gap may always be in contact,
// unless it would have to be higher than the known heights' range. With a resolution of 0 and heights without noise
// that were dilated at the grid's points, e is the surface at the touched points to rounding.
//
// In one row the ball does not reach beside the row. A radius below the spacings returns the heights. Throws Error if
// the sizes do not fit, a spacing is not finite and positive, radius or resolution are not finite or negative, or there
// are more than 10¹⁰ pairs of points to compare.
TipErosion erode_by_tip(std::span<const double> height_m, const HeightGridShape& shape, double tip_radius_m,
                        double resolution_m = 0.0);

// The erosion dilated again: the highest heights, nowhere above the given ones, that a ball of this radius can have
// measured; nan where the height is. A larger ball gives lower heights (granulometry, Serra 1982). Throws as above.
std::vector<double> open_by_tip(std::span<const double> height_m, const HeightGridShape& shape, double tip_radius_m);

// The erosion of a profile.
TipErosion erode_profile_by_tip(std::span<const double> height_m, double spacing_m, double tip_radius_m,
                                double resolution_m = 0.0);

}  // namespace asperity
