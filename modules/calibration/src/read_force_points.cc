#include "asperity/calibration/read_force_points.h"

#include <cmath>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::uint64_t kLargestPointsFile_bytes = std::uint64_t{64} << 20;
constexpr std::size_t kMostPoints = 1'000'000;

constexpr double kMostCounts = 1e12, kMostForce_N = 100.0;

double plausible(const CsvReader& reader, std::size_t column, double most, const char* what) {
  const double value = reader.finite(column);
  if (std::abs(value) > most) reader.fail(column, "'" + printable(reader.cell(column)) + "' is not " + what);
  return value;
}

}  // namespace

ForcePoints read_force_points(const std::filesystem::path& file) {
  const std::string name = printable(file.string(), 200);
  const std::string text = read_file(file, kLargestPointsFile_bytes);
  CsvReader reader(text, name);
  reader.accept_unterminated();
  const std::size_t counts = reader.require("counts");
  const std::size_t force = reader.require("force_N");
  ForcePoints out;
  while (reader.next()) {
    if (out.size() == kMostPoints) throw Error(name + ": more than a million readings");
    out.counts.push_back(plausible(reader, counts, kMostCounts, "counts of a converter"));
    out.force_N.push_back(
        plausible(reader, force, kMostForce_N,
                  "a force in newtons that a hand gives (100 N at most); grams times 0.00980665 are newtons"));
  }
  return out;
}

}  // namespace asperity
