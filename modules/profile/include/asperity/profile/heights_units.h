#pragma once

#include <string>
#include <vector>

namespace asperity {

// Where a unit comes from.
enum class UnitOrigin {
  kFile,     // the format has it, as GSF, X3P and our own profile.csv do
  kHeader,   // a header line of the table
  kSetting,  // a setting of the person
  kAssumed,  // nothing states it
};

// The unit in which the numbers of a file were read.
struct ReadUnit {
  double metres = 0.0;  // 0: there is none, as of positions in a file without them
  UnitOrigin origin = UnitOrigin::kFile;
};

struct HeightsUnits {
  ReadUnit height, position;
};

// How the numbers of a file were read.
struct HeightsOrigin {
  HeightsUnits units;
  double arithmetic_rms_m = 0.0;  // what sums of doubles of this size leave of nothing, root mean square
  // The most that rounding to the file's last digits can change the heights by, root mean square; 0: not known.
  double last_digit_rms_m = 0.0;
};

// `arithmetic_rms_m` of heights: 64 times the last bit of the largest.
double arithmetic_rms_m(const std::vector<double>& height_m);

// "µm", "nm", "mil", …; "2e-07 m" of a length without a name.
std::string length_unit_name(double metres);

// "file", "header", "setting" or "assumed".
std::string unit_origin_name(UnitOrigin origin);

// One line without its end: "heights in nm (header), positions in mm (header)"; where a unit is assumed, how to state
// it.
std::string units_text(const HeightsUnits& units);

}  // namespace asperity
