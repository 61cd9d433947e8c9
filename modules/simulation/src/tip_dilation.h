#pragma once

#include <vector>

namespace asperity {

// The path of the lowest point of a sphere of radius `tip_radius_m` that rolls over a profile:
// out(x) = max over |u| <= r of height(x + u) + sqrt(r² − u²) − r, exact on the profile's own grid
// (seed §3.1, Fig. 5). Relief across the stroke is not seen by the sphere's sides.
// `height_m` is uniform with `spacing_m`; the ends are held. A radius of 0 returns the profile.
std::vector<double> dilate_by_tip(const std::vector<double>& height_m, double spacing_m, double tip_radius_m);

// The profile as a compliant body shows it to a sphere that presses a contact disc of radius
// `contact_radius_m` into it: the mean over the disc, weighted with Hertz's pressure
// sqrt(1 − (u/a)²) (Johnson, Contact Mechanics, 1985, §3.4 and §4.2). Radius 0 returns the profile.
std::vector<double> smooth_by_contact(const std::vector<double>& height_m, double spacing_m, double contact_radius_m);

}  // namespace asperity
