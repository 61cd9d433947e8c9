#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// The core of a material ratio curve (ISO 21920-2 Rk…, ISO 25178-2 Sk…; as in ISO 13565-2:1996): the straight line of
// equivalence and the triangles of equal area above and below it. Lengths in the heights' unit, ratios 0 to 1.
struct MaterialCore {
  double k = 0.0;       // height of the core: the line's fall from 0 to 100 %
  double pk = 0.0;      // height of the reduced peaks, 2 A1 / mr1; 0 without any
  double vk = 0.0;      // depth of the reduced pits, 2 A2 / (1 − mr2)
  double ratio1 = 0.0;  // material ratio of the core's upper level
  double ratio2 = 1.0;  // of its lower level
};

// The material ratio curve (Abbott and Firestone) of samples: the height that a part q of them reach or exceed. The
// samples have equal weight; sample i of n in falling order stands for the part [i/n, (i+1)/n].
class MaterialCurve {
 public:
  // nan heights are left out. At least two must be present, finite.
  explicit MaterialCurve(std::span<const double> heights);

  std::size_t count() const { return falling_.size(); }

  // Height at the part `ratio`, straight between the samples' middles and level outside of them.
  double level(double ratio) const;
  // The part of the samples above `level`; half of those that are equal to it.
  double ratio_above(double level) const;
  // ∫ from 0 to `ratio` of height − level(ratio): material volume over area (Vm(p)).
  double material_volume(double ratio) const;
  // ∫ from `ratio` to 1 of level(ratio) − height: void volume over area (Vv(p)).
  double void_volume(double ratio) const;
  // The line of equivalence is the least-squares line through the 40 % of the samples over which the curve falls least;
  // of equal falls the first.
  MaterialCore core() const;

 private:
  // ∫ from 0 to `ratio` of the height.
  double integral(double ratio) const;

  std::vector<double> falling_;
  std::vector<double> sum_;  // of the first i heights, less the mean times i
  double mean_ = 0.0;
};

}  // namespace asperity
