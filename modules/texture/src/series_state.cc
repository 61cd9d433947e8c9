#include "asperity/texture/series_state.h"

#include "series_steps.h"

namespace asperity {

SeriesState start_series(std::uint64_t seed, std::uint64_t stream) {
  SeriesState state;
  state.random = Random(seed, stream);
  for (double& b : state.backward) b = fixed_time_normal(state.random);
  state.previous = fixed_time_normal(state.random);
  state.current = fixed_time_normal(state.random);
  return state;
}

}  // namespace asperity
