#pragma once

#include <span>

namespace asperity::registration {

// The mean height of a relief over the mesh, a priori.
struct ReliefLevel {
  double mean_m = 0.0;
  double sigma_m = 0.0;  // standard deviation
};

// From heights d at places u along the object (rising). A mesh has the face of an object: of a board that between its
// holes. A tip is over it for much of the way, and heights there are alike. h = d − c, with c the mean of d over the
// face within window_m/2 to either side; the face is the shortest interval of h that has three tenths of the way, and
// half as much to either side of it. Both are found in turn, at first with all heights as the face.
// If the interval is shorter than 0.3 of the RMS of h about its middle (0.77 for normally distributed heights, 0.58 for
// a sine, 0.5 for a Laplace distribution), there is a face, and the mean of the relief is that of h over it. A mesh
// that was averaged over the relief has its mean instead: half the distance stands for both. Otherwise 0 and the RMS of
// d − (mean of d within the window). With fewer than 20 heights no face is looked for.
ReliefLevel measure_relief_level(std::span<const double> d_m, std::span<const double> u_m, double window_m);

}  // namespace asperity::registration
