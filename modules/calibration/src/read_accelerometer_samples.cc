#include "asperity/calibration/read_accelerometer_samples.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"

namespace asperity {

namespace {

constexpr std::uint64_t kLargestFile_bytes = std::uint64_t{1} << 30;

bool blank(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; }

// The numbers of one line; nullopt if a word is none or there are more than four.
std::optional<std::vector<double>> numbers(std::string_view line) {
  std::vector<double> out;
  std::size_t at = 0;
  while (at < line.size()) {
    if (blank(line[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < line.size() && !blank(line[end])) ++end;
    const std::optional<double> value = parse_double(line.substr(at, end - at));
    if (!value || out.size() == 4) return std::nullopt;
    out.push_back(*value);
    at = end;
  }
  return out;
}

// Takes the next line off `rest`; false at the end.
bool next_line(std::string_view& rest, std::string_view& line) {
  if (rest.empty()) return false;
  const std::size_t end = rest.find('\n');
  line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return true;
}

bool is_bare(std::string_view text) {
  std::string_view line;
  while (next_line(text, line)) {
    if (trim(line).empty() || trim(line).front() == '#') continue;
    const auto first = numbers(line);
    return first && first->size() == 4;
  }
  return false;
}

// Takes readings whose times rise and counts the others.
struct Collector {
  AccelerometerSamples samples;
  std::size_t out_of_order = 0;

  bool take(double t_s, const Eigen::Vector3d& counts) {
    if (samples.size() > 0 && !(t_s > samples.t_s.back())) {
      ++out_of_order;
      return false;
    }
    samples.t_s.push_back(t_s);
    samples.counts.push_back(counts);
    return true;
  }

  void finish(AccelerometerFile& file) {
    if (out_of_order > 0)
      file.notes.push_back(fmt::format("{} rows whose time does not rise were left out", out_of_order));
    file.samples = std::move(samples);
  }
};

AccelerometerFile read_bare(std::string_view text, const std::string& name) {
  AccelerometerFile out;
  out.notes.emplace_back("a table of bare numbers: its columns were read as t_s, accel_i, accel_j, accel_k");
  Collector collector;
  std::string_view line;
  for (std::size_t place = 1; next_line(text, line); ++place) {
    if (trim(line).empty() || trim(line).front() == '#') continue;
    const auto row = numbers(line);
    if (!row || row->size() != 4) {
      throw Error(fmt::format("{}:{}: expected four numbers t i j k, not '{}'", name, place, printable(line)));
    }
    for (const double value : *row) {
      if (!std::isfinite(value)) throw Error(fmt::format("{}:{}: {} is not a finite reading", name, place, value));
    }
    collector.take((*row)[0], {(*row)[1], (*row)[2], (*row)[3]});
  }
  collector.finish(out);
  return out;
}

AccelerometerFile read_table(std::string_view text, const std::string& name) {
  CsvReader reader(text, name);
  reader.accept_unterminated();
  const std::size_t time = reader.require("t_s");
  const std::size_t axes[3] = {reader.require("accel_i"), reader.require("accel_j"), reader.require("accel_k")};
  const bool known = reader.find("fx_mps2") || reader.find("fy_mps2") || reader.find("fz_mps2");
  std::size_t force[3] = {};
  if (known) {
    const char* const names[3] = {"fx_mps2", "fy_mps2", "fz_mps2"};
    for (int i = 0; i < 3; ++i) force[i] = reader.require(names[i]);
  }
  const auto number = [&](std::size_t column) { return reader.finite(column); };
  AccelerometerFile out;
  Collector collector;
  while (reader.next()) {
    const Eigen::Vector3d counts(number(axes[0]), number(axes[1]), number(axes[2]));
    if (!collector.take(number(time), counts) || !known) continue;
    collector.samples.specific_force_mps2.emplace_back(number(force[0]), number(force[1]), number(force[2]));
  }
  collector.finish(out);
  return out;
}

}  // namespace

AccelerometerFile read_accelerometer_samples(const std::filesystem::path& file) {
  const std::string name = printable(file.string(), 200);
  const std::string text = read_file(file, kLargestFile_bytes);
  return is_bare(text) ? read_bare(text, name) : read_table(text, name);
}

AccelerometerFile accelerometer_samples_of(const Recording& recording) {
  AccelerometerFile out;
  const ProbeStream& probe = recording.probe;
  const bool limited = recording.info.adc_max > recording.info.adc_min;
  std::size_t saturated = 0;
  for (std::size_t i = 0; i < probe.size(); ++i) {
    const Eigen::Vector3d& counts = probe.accel_counts[i];
    if (limited && (counts.maxCoeff() >= recording.info.adc_max || counts.minCoeff() <= recording.info.adc_min)) {
      ++saturated;
      continue;
    }
    out.samples.t_s.push_back(static_cast<double>(probe.t_ns[i] - probe.t_ns.front()) * kNanosecond_s);
    out.samples.counts.push_back(counts);
  }
  if (saturated > 0) out.notes.push_back(fmt::format("{} rows at the converter's limits were left out", saturated));
  return out;
}

}  // namespace asperity
