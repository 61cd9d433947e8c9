#include "asperity/studio/read_report_item.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/pipeline/read_path.h"
#include "asperity/profile/measure_spectrum.h"
#include "asperity/studio/block.h"
#include "asperity/studio/measured_figures.h"
#include "kept_block.h"

namespace asperity::studio {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLargestResult_bytes = 16U << 20U;
constexpr std::uint64_t kLargestProfile_bytes = 256U << 20U;
constexpr int kDeepestResult = 32;
constexpr std::size_t kMostPathPoints = 20'000;      // a screen has fewer pixels along a path
constexpr std::size_t kMostProfilePoints = 400'000;  // 10 m at the usual spacing

Json read_result(const fs::path& file) {
  const std::string text = read_file(file, kLargestResult_bytes);
  const std::string name = printable(file.string(), 200);
  const auto watch = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepestResult) throw Error(name + ": nested more than " + std::to_string(kDeepestResult) + " deep");
    return true;
  };
  Json out;
  try {
    out = Json::parse(text, watch);
  } catch (const Json::exception& error) {
    throw Error(name + ": is not JSON: " + printable(error.what(), 200));
  }
  const auto format = out.is_object() ? out.find("format") : out.end();
  if (!out.is_object() || format == out.end() || *format != "asperity-result") {
    throw Error(name + ": is not a result of asperity process");
  }
  if (out.value("version", Json(nullptr)) != 1) {
    throw Error(name + ": is of version " + printable(out.value("version", Json(nullptr)).dump()) + "; 1 is read");
  }
  return out;
}

// Every how many-th row is kept so that there are no more than `most`.
std::size_t step_for(std::size_t rows, std::size_t most) { return std::max<std::size_t>(1, (rows + most - 1) / most); }

std::vector<float> thinned(const std::vector<double>& values, std::size_t step) {
  std::vector<float> out;
  out.reserve(values.size() / step + 1);
  for (std::size_t i = 0; i < values.size(); i += step) out.push_back(static_cast<float>(values[i]));
  return out;
}

// A column that an older file does not have is nan.
void add_profile(const fs::path& file, BlockWriter& block) {
  constexpr std::array<const char*, 6> kColumns{"s_m", "height_m", "sigma_m", "texture_m", "force_N", "speed_mps"};
  constexpr std::size_t kTexture = 3;
  const std::string text = read_file(file, kLargestProfile_bytes);
  CsvReader csv(text, printable(file.string(), 200));
  csv.accept_unterminated();
  std::array<std::optional<std::size_t>, kColumns.size()> places;
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    places[k] = k < 2 ? csv.require(kColumns[k]) : csv.find(kColumns[k]);
  }
  std::array<std::vector<double>, kColumns.size()> values;
  while (csv.next()) {
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
      const double value = places[k] ? csv.number(*places[k]) : std::numeric_limits<double>::quiet_NaN();
      if (std::isinf(value)) csv.fail(*places[k], "is not finite");
      values[k].push_back(value);
    }
  }
  const std::vector<double>& s_m = values[0];
  const std::size_t step = step_for(s_m.size(), kMostProfilePoints);
  const double spacing_m = s_m.size() < 2 ? 0.0 : (s_m.back() - s_m.front()) / static_cast<double>(s_m.size() - 1);
  if (s_m.size() > 1 && !(spacing_m > 0.0)) throw Error(printable(file.string(), 200) + ": s_m does not rise");
  for (std::size_t k = 1; k < kColumns.size(); ++k) {
    block.add("profile_" + std::string(kColumns[k]), thinned(values[k], step));
  }
  block.head()["profile"] = {{"samples", s_m.size()},
                             {"every", step},
                             {"points", (s_m.size() + step - 1) / step},
                             {"first_m", s_m.empty() ? 0.0 : s_m.front()},
                             {"spacing_m", spacing_m * static_cast<double>(step)}};
  const PowerSpectrum spectrum = s_m.size() < 2 ? PowerSpectrum{} : measure_spectrum(values[kTexture], spacing_m);
  block.head()["spectrum"] = {{"segments", spectrum.segments}};
  block.add("spectrum_cycles_per_mm", spectrum.frequency);
  block.add("spectrum_density_m2_mm", spectrum.density);
}

void add_path(const fs::path& file, BlockWriter& block) {
  std::vector<float> p_m;
  std::size_t points = 0, step = 1;
  double duration_s = 0.0;
  if (fs::is_regular_file(file)) {
    const TipMotion motion = read_path(file).motion;
    points = motion.size();
    step = step_for(points, kMostPathPoints);
    duration_s = static_cast<double>(motion.t_ns.back() - motion.t_ns.front()) * kNanosecond_s;
    const Eigen::Vector3d origin_m = motion.p_world_tip_m[points / 2];
    for (std::size_t i = 0; i < points; i += step) {
      for (const double x : Eigen::Vector3d(motion.p_world_tip_m[i] - origin_m)) p_m.push_back(static_cast<float>(x));
    }
  }
  const std::size_t drawn = p_m.size() / 3;
  block.head()["trajectory"] = {{"samples", points}, {"every", step}, {"points", drawn}, {"duration_s", duration_s}};
  block.add("trajectory_p_m", p_m, {drawn, 3});
}

void gather(const fs::path& folder, int deepest, std::vector<fs::path>& out) {
  if (fs::is_regular_file(folder / "result.json")) out.push_back(folder);
  if (out.size() > kMaxReportItems || deepest == 0) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool hidden = entry.path().filename().string().starts_with('.');
    if (entry.is_directory() && !entry.is_symlink() && !hidden) gather(entry.path(), deepest - 1, out);
  }
}

}  // namespace

std::vector<fs::path> find_results(const fs::path& folder) {
  constexpr int kDeepest = 3;
  const std::string name = printable(folder.string(), 200);
  if (!fs::is_directory(folder)) {
    throw Error(name + (fs::exists(folder) ? ": is no folder" : ": no such folder"));
  }
  std::vector<fs::path> out;
  gather(folder, kDeepest, out);
  if (out.empty()) throw Error(name + ": holds no result of asperity process (no result.json)");
  if (out.size() > kMaxReportItems) {
    throw Error(name + ": holds more than " + std::to_string(kMaxReportItems) + " results, too many for one report");
  }
  std::sort(out.begin(), out.end());
  return out;
}

ReportItem read_report_item(const fs::path& folder, const std::string& name) {
  const Json result = read_result(folder / "result.json");
  ReportItem out;
  const auto recording = result.find("recording");
  out.name =
      !name.empty() || recording == result.end() || !recording->is_string() ? name : recording->get<std::string>();
  if (auto kept = kept_block(folder / "report.html", result)) {
    out.block = std::move(*kept);
    return out;
  }
  BlockWriter block("measured");
  block.head()["result"] = result;
  block.head()["world"] = "camera";
  block.head()["figures"] = measured_figures(result);
  block.head()["dropped"] = result.value("problems", Json::array());
  block.head()["gaps"] = Json::array();
  block.head()["gap_count"] = 0;
  block.head()["compliance"] = result.value("compliance", Json::object());
  add_profile(folder / "profile.csv", block);
  add_path(folder / "trajectory.csv", block);
  out.block = block.take();
  return out;
}

}  // namespace asperity::studio
