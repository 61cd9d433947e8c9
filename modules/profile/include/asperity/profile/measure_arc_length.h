#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/base/config.h"

namespace asperity {

struct ArcLengthConfig {
  double direction_cutoff_cycles_per_mm = 0.03;
  double bend_cutoff_cycles_per_mm = 0.14;
  double bend_m = 0.0;   // 0: from the motion's own σ, see find_base_path.h
  double noise_m = 0.0;  // likewise
  double along_cutoff_Hz = 0.0;
  double rest_speed_mps = 1e-3;
  double rest_fraction = 0.15;

  template <class V>
  void visit(V& v) {
    v.field("direction_cutoff_cycles_per_mm", direction_cutoff_cycles_per_mm,
            "low-pass of the path that gives the direction of travel", {1e-3, 10.0});
    v.field("bend_cutoff_cycles_per_mm", bend_cutoff_cycles_per_mm,
            "the same in bends; shorter ones are tremor, not path", {1e-3, 10.0});
    v.field("bend_m", bend_m,
            "a bend that the low-pass cuts by more than this is followed; twice this wholly; 0: by sigma", {0.0, 1.0});
    v.field("noise_m", noise_m, "standard deviation of the path's points; 0: by sigma", {0.0, 1.0});
    v.field("along_cutoff_Hz", along_cutoff_Hz, "low-pass of the progress along the path; 0 for none", {0.0, 1e5});
    v.former("along_cutoff_hz");
    v.field("rest_speed_mps", rest_speed_mps, "slower than this the tip has no direction of its own", {0.0, 10.0});
    v.field("rest_fraction", rest_fraction, "the same as a fraction of the 80th percentile of the speed", {0.0, 1.0});
  }
};

struct ArcLength {
  std::vector<double> s_m;                  // one a sample, 0 up to the first usable one, constant after the last
  std::vector<double> speed_mps;            // of the low-passed path, one a sample
  std::vector<std::size_t> turning_points;  // samples at which a stroke reverses (by more than 90°)
  double bends_m = 0.0;                     // what a direction that follows bends closer adds to them, by noise too
};

// Arc length of a path given in coordinates of its developed surface, u_m, one a sample at the rising
// times t_s; `usable` (empty or one a sample) marks samples in contact.
//
// Summing |Δu| counts noise as travel: with an error of σ a sample at spacing d each step grows by about
// σ²/d, without bound as the rate rises (seed §5.1; erratum 23). Here a step counts by its component
// along the direction of travel, ds = t·Δu with t the unit velocity of the low-passed path. Errors along
// t then cancel from step to step, whatever the rate, and only those of t remain, which shorten the path
// by half the square of the angle. The low-pass works in time; its cut-off is that of the config times the
// speed's 80th percentile: the lower one, and where that cuts a bend by more than bend_m, the higher. A bend is what is
// so cut and what bends beside it, and, but for a bend_m below 2 noise_m, a reversal of 60° or more; there the
// direction is that of four times the higher cut-off. Real tangential motion at any frequency (stick–slip) is kept. At
// rest t is held, so s does not creep; it may step back by what the tip steps back. In the rests before and after the
// path it has one value, their median, so that the path does not grow by the range of its noise there; a tip that
// creeps during such a rest, by more than two to four `noise_m`, is on its way, and begins or ends where the rest's
// outer end was. Where a stroke reverses, the path is cut at its outermost point and s keeps growing. Throws Error if
// the sizes differ or the times do not rise.
ArcLength measure_arc_length(std::span<const double> t_s, std::span<const Eigen::Vector2d> u_m,
                             std::span<const char> usable, const ArcLengthConfig& config);

}  // namespace asperity
