#include "scan/bench_config.h"

#include <string>

namespace asperity::studio {

SimulationConfig simulation_of(const BenchConfig& config) {
  SimulationConfig out = make_simulation_config(kBenchSurfaceNames.at(static_cast<std::size_t>(config.surface)),
                                                kProbeModelNames.at(static_cast<std::size_t>(config.probe)),
                                                kBenchMaterialNames.at(static_cast<std::size_t>(config.material)));
  out.seed = config.seed;
  out.hand.speed_mps = config.speed_mps;
  out.hand.length_m = config.length_m;
  out.hand.force_N = config.force_N;
  out.hand.rest_s = config.rest_s;
  return out;
}

LiveBenchConfig live_bench_of(const BenchConfig& config) {
  LiveBenchConfig out;
  out.camera.rate_Hz = config.camera_rate_Hz;
  out.camera.clutter = config.background;
  out.link_seed = config.seed;
  out.drop_after_s = config.drop_after_s;
  out.settle_s = 0.1;
  out.linger_s = 0.3;
  return out;
}

}  // namespace asperity::studio
