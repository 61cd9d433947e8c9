#pragma once

#include <span>
#include <string>

namespace asperity {

// Samples as a WAV file, one channel of 16-bit PCM: `full_scale` becomes 32767, what lies beyond is clipped. The same
// samples give the same bytes. By hand: libsndfile would load nine shared libraries at each start for a header of 44
// bytes (ADR 14). Throws Error for a sample that is not finite, a scale that is not positive, or a rate outside 1 Hz to
// 1 MHz.
std::string format_wav(std::span<const double> samples, double rate_Hz, double full_scale);

}  // namespace asperity
