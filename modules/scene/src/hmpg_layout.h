#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace asperity {

// The numbers of HMPG, the distribution format of ISO/IEC 23090-31, as MPEGGroup/HapticReferenceSoftware has them:
// units and packets at 8ec8b57f (IOStream, IOBinaryFields: MIHS units with a layer), modalities at 1bc5bef5
// (Perception), which is later. Fields are in format_hmpg.cc, in the order of the file.

enum class HmpgUnit { kInitialization = 0, kTemporal = 1, kSpatial = 2, kSilent = 3 };

enum class HmpgPacket {
  kTiming = 0,
  kExperience = 1,
  kPerception = 2,
  kChannel = 3,
  kBand = 4,
  kData = 5,
  kInitializationTiming = 11
};

// In the order of HapticModality.
inline constexpr std::array<int, 4> kHmpgModalities{6, 10, 12, 13};
inline constexpr int kHmpgCurveBand = 1;
inline constexpr int kHmpgLinearCurve = 2;
inline constexpr int kHmpgBasisEffect = 0;
inline constexpr int kHmpgNoReferenceDevice = 255;
inline constexpr int kHmpgBodyPartMask = 1;  // of a channel's optional fields: the one that is always written

inline constexpr std::size_t kHmpgUnitHeader_bytes = 9;
inline constexpr std::size_t kHmpgPacketHeader_bytes = 3;
inline constexpr std::size_t kLargestHmpgPacket_bytes = (std::size_t{1} << 17) - 1;
inline constexpr std::int64_t kLastHmpgPosition = (std::int64_t{1} << 24) - 1;  // 25 bits with a sign
inline constexpr int kHighestHmpgFrequency = 65535;

// A number from `low` to `high` as an integer of 1 to 32 bits, the nearest.
inline std::int64_t hmpg_code(double value, double low, double high, int bits) {
  const double most = std::ldexp(1.0, bits) - 1.0;
  return std::llround(std::clamp((value - low) / (high - low), 0.0, 1.0) * most);
}

inline double hmpg_number(std::int64_t code, double low, double high, int bits) {
  return low + static_cast<double>(code) / (std::ldexp(1.0, bits) - 1.0) * (high - low);
}

inline constexpr double kHighestHmpgGain = 10000.0;

inline std::int64_t hmpg_amplitude_code(double amplitude) { return hmpg_code(amplitude, -1.0, 1.0, 8); }
inline double hmpg_amplitude(std::int64_t code) { return hmpg_number(code, -1.0, 1.0, 8); }
inline std::int64_t hmpg_gain_code(double gain) { return hmpg_code(gain, -kHighestHmpgGain, kHighestHmpgGain, 32); }
inline double hmpg_gain(std::int64_t code) { return hmpg_number(code, -kHighestHmpgGain, kHighestHmpgGain, 32); }
inline std::int64_t hmpg_weight_code(double weight) { return hmpg_code(weight, 0.0, kHighestHmpgGain, 32); }
inline double hmpg_weight(std::int64_t code) { return hmpg_number(code, 0.0, kHighestHmpgGain, 32); }

}  // namespace asperity
