#pragma once

// What the processor in hand can do. A function with ASPERITY_TARGET_AVX2 is called only where kProcessorHasAvx2 is
// true; it computes in the same order as the one without, so that the bytes are the same.
#if defined(__x86_64__)
#define ASPERITY_TARGET_AVX2 [[gnu::target("avx2")]]
#else
#define ASPERITY_TARGET_AVX2
#endif

namespace asperity {

#if defined(__x86_64__)
inline const bool kProcessorHasAvx2 = __builtin_cpu_supports("avx2") != 0;
#else
inline constexpr bool kProcessorHasAvx2 = false;
#endif

}  // namespace asperity
