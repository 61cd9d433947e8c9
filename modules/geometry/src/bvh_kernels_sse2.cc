#include "bvh_ray.h"
#include "bvh_search.h"
#include "bvh_within.h"
#include "simd_sse2.h"

namespace asperity::bvh {

const Kernels& sse2_kernels() {
  static constexpr Kernels kKernels{closest<Floats8Sse2>, within<Floats8Sse2>, cast_ray<Floats8Sse2>};
  return kKernels;
}

}  // namespace asperity::bvh
