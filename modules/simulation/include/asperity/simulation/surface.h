#pragma once

namespace asperity {

// A surface's fine relief above its base shape. Pure and safe to call from several threads.
class Surface {
 public:
  virtual ~Surface() = default;

  // Height above the nominal level, m, outward positive, at `along_m` along the main direction of the
  // stroke and `across_m` across it, both measured on the base shape from the middle of the object.
  virtual double height_m(double along_m, double across_m) const = 0;
};

}  // namespace asperity
