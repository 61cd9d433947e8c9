#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "asperity/simulation/live_bench_config.h"
#include "asperity/simulation/simulation_config.h"
#include "asperity/simulation/surface_config.h"

namespace asperity::studio {

// The surfaces that need no file.
inline constexpr std::array<std::string_view, 5> kBenchSurfaceNames{"sine", "protoboard", "cable_tie", "sandpaper",
                                                                    "clay_pot"};
enum class BenchSurface { kSine, kProtoboard, kCableTie, kSandpaper, kClayPot };
inline constexpr std::array<std::string_view, 3> kBenchMaterialNames{"stiff", "cork", "soft_rubber"};
enum class BenchMaterial { kStiff, kCork, kSoftRubber };

// What the bench scans and how; all else is as `asperity simulate` has it.
struct BenchConfig {
  BenchSurface surface = BenchSurface::kProtoboard;
  BenchMaterial material = BenchMaterial::kStiff;
  ProbeModel probe = ProbeModel::kOpen;
  double speed_mps = 0.025;
  double length_m = 0.08;
  double force_N = 0.8;
  double rest_s = 0.8;
  double camera_rate_Hz = 60.0;
  double drop_after_s = 0.1;
  bool background = true;
  std::int64_t seed = 1;

  template <class V>
  void visit(V& v) {
    v.choice("surface", surface, kBenchSurfaceNames, "scanned surface");
    v.choice("material", material, kBenchMaterialNames, "material of the surface");
    v.choice("probe", probe, kProbeModelNames,
             "probe model: what (8 bit, 400 Hz; the probe of the thesis) or open (16 bit, 4 kHz)");
    v.field("speed_mps", speed_mps, "mean speed of the hand, m/s", {0.001, 1.0});
    v.field("length_m", length_m, "length of the stroke, m", {0.005, 0.3});
    v.field("force_N", force_N, "force of the hand, N", {0.05, 10.0});
    v.field("rest_s", rest_s,
            "static interval before and after the stroke, in which the probe is set down and lifted off, s",
            {0.3, 10.0});
    v.field("camera_rate_Hz", camera_rate_Hz, "frame rate of the camera, Hz", {5.0, 240.0});
    v.field("drop_after_s", drop_after_s, "on a slow machine, frames that are later than this are dropped, s",
            {0.01, 3600.0});
    v.field("background", background, "a cluttered background behind the probe");
    v.field("seed", seed, "seed of the random numbers; the same seed gives the same scan", {0.0, 9e15});
  }
};

// The bench's own settings for these. Throws Error for what cannot be simulated.
SimulationConfig simulation_of(const BenchConfig& config);
LiveBenchConfig live_bench_of(const BenchConfig& config);

}  // namespace asperity::studio
