#pragma once

#include <cstdint>
#include <vector>

namespace asperity {

// Heights along a growing path on the multiples of a spacing, each final as soon as the path has passed it by half a
// spacing and one sample: the causal counterpart of resample_over_path.h. Samples are averaged over a quarter of the
// spacing; a cubic goes through them (slopes from the neighbours), and a point is the mean of four places in its cell.
// Where the path steps back, only what is new counts. Thread-safe: no.
class CausalGrid {
 public:
  struct Sample {
    std::int64_t t_ns = 0;
    double s_m = 0.0;
    double height_m = 0.0;
    double sigma_m = 0.0;
    double force_N = 0.0;
    double speed_mps = 0.0;
  };

  // Throws Error for a spacing that is not positive.
  CausalGrid(double spacing_m, double max_hole_m);

  // The next sample; points that it completes are appended to `out`, their s_m multiples of the spacing that rise by
  // one spacing each. nan heights mark those in a hole.
  void push(const Sample& sample, std::vector<Sample>& out);
  // The path goes on elsewhere, or out of contact: what is in hand is completed, and a hole begins.
  void cut(std::vector<Sample>& out);

 private:
  static constexpr int kParts = 4;  // of a cell
  struct Knot {
    double s = 0.0, t = 0.0, height = 0.0, sigma = 0.0, force = 0.0, speed = 0.0;
  };
  void close_knot(std::vector<Sample>& out);
  void add_knot(const Knot& knot, std::vector<Sample>& out);
  void interpolate(std::size_t from, std::vector<Sample>& out);
  void add_part(std::int64_t number, const Knot& at, std::vector<Sample>& out);
  void fill_holes(std::int64_t up_to_cell, std::vector<Sample>& out);

  double spacing_m_;
  double max_hole_m_;
  std::int64_t origin_ns_ = 0;
  std::int64_t last_ns_ = 0;  // of the last point: those in a hole have it too
  bool any_ = false;

  std::int64_t quarter_ = 0;  // that is being averaged
  Knot sum_{};
  int in_sum_ = 0;
  std::vector<Knot> knots_;     // of this run, the last four
  std::int64_t next_part_ = 0;  // number of the next part to be interpolated
  std::int64_t next_cell_ = 0;  // of the next point
  bool any_cell_ = false;       // a point has been given
  Knot cell_sum_{};
  int in_cell_ = 0;
};

}  // namespace asperity
