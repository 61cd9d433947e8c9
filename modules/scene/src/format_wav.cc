#include "asperity/scene/format_wav.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "little_endian.h"

namespace asperity {

std::string format_wav(std::span<const double> samples, double rate_Hz, double full_scale) {
  constexpr std::size_t kMostSamples = (std::size_t{1} << 31) - 64;
  if (!(rate_Hz >= 1.0) || !(rate_Hz <= 1e6)) throw Error("wav: a rate of " + number_text(rate_Hz) + " Hz");
  if (!(full_scale > 0.0) || !std::isfinite(full_scale)) throw Error("wav: a full scale of " + number_text(full_scale));
  if (samples.size() > kMostSamples / 2) throw Error("wav: too many samples");
  const auto rate = static_cast<std::uint32_t>(std::lround(rate_Hz));
  const auto bytes = static_cast<std::uint32_t>(2 * samples.size());
  std::string out = "RIFF";
  out.reserve(44 + bytes);
  append_little_endian(out, 36 + bytes, 4);
  out += "WAVEfmt ";
  append_little_endian(out, 16, 4);
  append_little_endian(out, 1, 2);  // PCM
  append_little_endian(out, 1, 2);  // channels
  append_little_endian(out, rate, 4);
  append_little_endian(out, 2 * rate, 4);  // bytes a second
  append_little_endian(out, 2, 2);         // bytes a sample of all channels
  append_little_endian(out, 16, 2);
  out += "data";
  append_little_endian(out, bytes, 4);
  for (const double sample : samples) {
    if (!std::isfinite(sample)) throw Error("wav: a sample is not finite");
    const double level = std::clamp(std::round(sample / full_scale * 32767.0), -32768.0, 32767.0);
    append_little_endian(out, static_cast<std::uint16_t>(static_cast<std::int16_t>(level)), 2);
  }
  return out;
}

}  // namespace asperity
