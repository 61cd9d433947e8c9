// Compiled for AVX2 and FMA: nothing here may be called before the processor is known to have them, and whatever
// else is included must not leave code behind that the linker could share with the rest.
#include "bvh_ray.h"
#include "bvh_search.h"
#include "bvh_within.h"
#include "simd_avx2.h"

namespace asperity::bvh {

const Kernels& avx2_kernels() {
  static constexpr Kernels kKernels{closest<Floats8Avx2>, within<Floats8Avx2>, cast_ray<Floats8Avx2>};
  return kKernels;
}

}  // namespace asperity::bvh
