#include "asperity/studio/read_report_item.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/json/parse_json.h"
#include "asperity/pipeline/read_path.h"
#include "asperity/profile/measure_surface_spectrum.h"
#include "asperity/studio/block.h"
#include "asperity/studio/measured_metrics.h"
#include "kept_block.h"
#include "profile_block.h"
#include "result_tables.h"
#include "thinned.h"

namespace asperity::studio {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLargestTrajectory_bytes = 1U << 30U;
constexpr std::size_t kMostPathPoints = 20'000;      // a screen has fewer pixels along a path
constexpr std::size_t kMostProfilePoints = 400'000;  // 10 m at the usual spacing

// Of results that were written before there was a file of it: as it is drawn, without intervals.
SurfaceSpectrum spectrum_of(const Profile& profile) {
  return profile.size() > 1 ? measure_surface_spectrum(profile.texture_m, profile.spacing_m, {}) : SurfaceSpectrum{};
}

void add_path(const std::optional<std::string_view>& text, const std::string& name, BlockWriter& block) {
  TipMotion motion;
  if (text) motion = parse_path(*text, name).motion;
  const std::size_t points = motion.size();
  const Chosen chosen = choose_samples(points, kMostPathPoints);
  const double duration_s =
      points == 0 ? 0.0 : static_cast<double>(motion.t_ns.back() - motion.t_ns.front()) * kNanosecond_s;
  block.head()["trajectory"] = {
      {"samples", points}, {"every", chosen.every}, {"points", chosen.index.size()}, {"duration_s", duration_s}};
  const Eigen::Vector3d origin_m = points == 0 ? Eigen::Vector3d(0.0, 0.0, 0.0) : motion.p_world_tip_m[points / 2];
  add_points(block, "trajectory_p_m", chosen, motion.p_world_tip_m, origin_m);
}

std::string title_of(const Json& result, const std::string& name) {
  const Json* recording = result.find("recording");
  return !name.empty() || recording == nullptr || !recording->is_string() ? name : recording->text();
}

void find_in(const fs::path& folder, int deepest, std::vector<fs::path>& out) {
  if (fs::is_regular_file(folder / "result.json")) out.push_back(folder);
  if (out.size() > kMaxReportItems || deepest == 0) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool hidden = entry.path().filename().string().starts_with('.');
    if (entry.is_directory() && !entry.is_symlink() && !hidden) find_in(entry.path(), deepest - 1, out);
  }
}

std::string called(const fs::path& folder, const char* file) { return printable((folder / file).string(), 200); }

ReportItem make_item(const Json& result, std::string_view profile, const std::optional<std::string_view>& trajectory,
                     const std::optional<std::string_view>& spectrum, const fs::path& folder, const std::string& name) {
  BlockWriter block("measured");
  block.head()["result"] = result;
  block.head()["world"] = "camera";
  block.head()["figures"] = measured_metrics(result);
  block.head()["dropped"] = result.value("problems", Json::array());
  block.head()["gaps"] = Json::array();
  block.head()["gap_count"] = 0;
  block.head()["compliance"] = result.value("compliance", Json::object());
  const Profile measured = parse_profile(profile, called(folder, "profile.csv"));
  add_profile(measured, kMostProfilePoints, block);
  add_spectrum(spectrum ? parse_spectrum(*spectrum, called(folder, "spectrum.csv")) : spectrum_of(measured), block);
  add_path(trajectory, called(folder, "trajectory.csv"), block);
  return {title_of(result, name), block.take()};
}

}  // namespace

std::vector<fs::path> find_results(const fs::path& folder) {
  constexpr int kDeepest = 3;
  const std::string name = printable(folder.string(), 200);
  if (!fs::is_directory(folder)) {
    throw Error(name + (fs::exists(folder) ? ": is not a folder" : ": no such folder"));
  }
  std::vector<fs::path> out;
  find_in(folder, kDeepest, out);
  if (out.empty()) throw Error(name + ": contains no result of asperity process (no result.json)");
  if (out.size() > kMaxReportItems) {
    throw Error(name + ": contains more than " + std::to_string(kMaxReportItems) + " results, too many for one report");
  }
  std::sort(out.begin(), out.end());
  return out;
}

ReportItem read_report_item(const fs::path& folder, const std::string& name) {
  const Json result =
      parse_result(read_file(folder / "result.json", kLargestResult_bytes), called(folder, "result.json"));
  if (auto kept = kept_block(folder / "report.html", result)) return {title_of(result, name), std::move(*kept)};
  const std::string profile = read_file(folder / "profile.csv", kLargestProfile_bytes);
  std::optional<std::string> trajectory;
  if (fs::is_regular_file(folder / "trajectory.csv"))
    trajectory = read_file(folder / "trajectory.csv", kLargestTrajectory_bytes);
  std::optional<std::string> spectrum;
  if (fs::is_regular_file(folder / "spectrum.csv"))
    spectrum = read_file(folder / "spectrum.csv", kLargestProfile_bytes);
  return make_item(result, profile, trajectory, spectrum, folder, name);
}

ReportItem parse_report_item(std::string_view result, std::string_view profile,
                             const std::optional<std::string_view>& trajectory, const fs::path& folder,
                             const std::string& name) {
  return make_item(parse_result(result, called(folder, "result.json")), profile, trajectory, {}, folder, name);
}

}  // namespace asperity::studio
