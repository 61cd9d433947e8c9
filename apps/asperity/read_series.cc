#include "read_series.h"

#include <cmath>
#include <cstdint>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity::app {

SeriesTable read_series(const std::string& file) {
  constexpr std::uint64_t kLargestFile_bytes = 512ULL << 20;
  const std::string text = read_file(file, kLargestFile_bytes);
  CsvReader csv(text, file);
  const std::size_t time = csv.require("t_s");
  const std::size_t acceleration = csv.require("acceleration_mps2");
  const std::size_t speed = csv.require("speed_mps");
  const std::size_t force = csv.require("force_N");
  SeriesTable table;
  std::vector<double> t_s;
  while (csv.next()) {
    t_s.push_back(csv.finite(time));
    table.acceleration_mps2.push_back(csv.finite(acceleration));
    table.speed_mps.push_back(csv.finite(speed));
    table.force_N.push_back(csv.finite(force));
  }
  if (t_s.size() < 2) throw Error(file + ": fewer than two rows");
  const double step_s = (t_s.back() - t_s.front()) / static_cast<double>(t_s.size() - 1);
  if (!(step_s > 0.0)) throw Error(file + ": t_s does not rise");
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    const double expected_s = t_s.front() + static_cast<double>(i) * step_s;
    if (!(std::abs(t_s[i] - expected_s) <= 1e-2 * step_s)) {
      throw Error(file + ": t_s is not even: row " + std::to_string(i + 1) + " has " + number_text(t_s[i]) + " where " +
                  number_text(expected_s) + " was expected");
    }
  }
  table.rate_Hz = 1.0 / step_s;
  return table;
}

}  // namespace asperity::app
