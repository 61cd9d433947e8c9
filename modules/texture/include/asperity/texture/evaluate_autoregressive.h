#pragma once

#include <array>
#include <span>

#include "asperity/texture/autoregressive.h"
#include "asperity/texture/series_state.h"

namespace asperity {

// Which models a point of the speed-force plane is mixed from: weights are not negative and sum to 1.
struct SeriesBlend {
  std::array<int, 3> model{};
  std::array<double, 3> weight{};
  int triangle = -1;  // -1: on the border, or beyond it
};

// The triangle that holds the point, tried from `hint` first; beyond the border the nearest point of it, distances in
// units of max_speed and max_force. Time bounded by the number of triangles.
SeriesBlend blend_models(const AutoregressiveTexture& texture, double speed_mps, double force_N, int hint) noexcept;

// The filter at a point: reflection coefficients, always within ±1, and numerator from the mixed frequencies. The
// variance of the output is mixed itself, and what comes from the filter is normalised to it: computed from a mixed
// excitation, or from a mixed gain, it would be too loud or too soft by far between filters of very different gain
// (docs/texture-autoregressive.md).
struct BlendedFilter {
  int order = 0;
  int ma_order = 0;
  std::array<double, kMaxSeriesOrder> k{};
  std::array<double, kMaxSeriesOrder> b{};
  double numerator_sigma = 1.0;        // of the numerator's output, given 1/A's of unit variance
  double neighbour_correlation = 0.0;  // of the output, from one model sample to the next
  double sigma_mps2 = 0.0;             // of the output
};
BlendedFilter blended_filter(const AutoregressiveTexture& texture, const SeriesBlend& blend) noexcept;

// The next acceleration of the tool, m/s², `dt_s` after the last, stroking at `speed_mps` under `force_N`; inputs that
// are not finite or negative count as 0, and at rest or without force there is none. The texture must have been
// prepared (prepare_autoregressive). The noise runs through 1/A as a normalised lattice (Gray and Markel 1975): each
// section is a rotation, so that the filter stays bounded however fast speed and force change, and the output has the
// mixed variance at every step; with a numerator, whose memory is of the filters before, where they change slowly
// against its length. Between the model's samples the output is interpolated, one model sample late, and scaled so that
// its variance remains; convert_rate() first if the rates differ, or the upper octave is softened. Fixed time but for
// the search in the triangulation and the number of model samples in dt_s, at most 16. Realtime-safe: yes. Thread-safe:
// yes, with a state each.
double next_acceleration_mps2(const AutoregressiveTexture& texture, SeriesState& state, double speed_mps,
                              double force_N, double dt_s) noexcept;

// The same times mass_kg; the normal part moved up by offset_sigmas standard deviations and clamped (erratum 20).
SeriesForce next_force(const AutoregressiveTexture& texture, SeriesState& state, double speed_mps, double force_N,
                       double dt_s) noexcept;

}  // namespace asperity
