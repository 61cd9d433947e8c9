#include "asperity/scene/format_wav.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/text.h"

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
  append_little_endian<std::uint32_t>(out, 36 + bytes);
  out += "WAVEfmt ";
  append_little_endian<std::uint32_t>(out, 16);
  append_little_endian<std::uint16_t>(out, 1);  // PCM
  append_little_endian<std::uint16_t>(out, 1);  // channels
  append_little_endian<std::uint32_t>(out, rate);
  append_little_endian<std::uint32_t>(out, 2 * rate);  // bytes a second
  append_little_endian<std::uint16_t>(out, 2);         // bytes a sample of all channels
  append_little_endian<std::uint16_t>(out, 16);
  out += "data";
  append_little_endian<std::uint32_t>(out, bytes);
  for (const double sample : samples) {
    if (!std::isfinite(sample)) throw Error("wav: a sample is not finite");
    const double level = std::clamp(std::round(sample / full_scale * 32767.0), -32768.0, 32767.0);
    append_little_endian(out, static_cast<std::int16_t>(level));
  }
  return out;
}

}  // namespace asperity
