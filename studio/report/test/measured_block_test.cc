#include "asperity/studio/measured_block.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "asperity/pipeline/process_recording.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_block.h"

namespace asperity::studio {
namespace {

const Recording& scan() {
  static const Recording recording = [] {
    SimulationConfig config = make_simulation_config("protoboard", "what");
    config.hand.length_m = 0.04;
    return simulate_recording(config);
  }();
  return recording;
}

ReadBlock block_of(const ProcessResult& result, const MeasuredBlockConfig& config = {}) {
  return read_block(measured_block(result, scan(), "holes", config).take());
}

// A metric by its key in result.json.
const Json& at(const Json& result, const std::string& key) {
  const Json* place = &result;
  std::size_t begin = 0;
  while (begin <= key.size()) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    place = &place->at(key.substr(begin, end - begin));
    begin = end + 1;
  }
  return *place;
}

TEST(MeasuredBlock, HoldsTheResultPointByPoint) {
  const ProcessResult result = process_recording(scan(), {});
  const ReadBlock block = block_of(result);
  EXPECT_EQ(block.head["kind"], "measured");
  EXPECT_EQ(block.head["result"]["recording"], "holes");
  const auto& height_m = block.arrays.at("profile_height_m");
  ASSERT_EQ(height_m.size(), result.profile.size());
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    const double s_m = block.head["profile"]["first_m"].get<double>() +
                       block.head["profile"]["spacing_m"].get<double>() * static_cast<double>(i);
    EXPECT_NEAR(s_m, result.profile.s_m[i], 1e-12);
    EXPECT_EQ(std::isfinite(height_m[i]), std::isfinite(result.profile.height_m[i]));
    if (!std::isfinite(height_m[i])) continue;
    EXPECT_NEAR(height_m[i], result.profile.height_m[i], 1e-9);
  }
  const TipMotion& motion = result.trajectory.motion;
  const auto& p_m = block.arrays.at("trajectory_p_m");
  EXPECT_EQ(block.shapes.at("trajectory_p_m"), (std::vector<std::size_t>{motion.size(), 3}));
  for (std::size_t i = 0; i < motion.size(); ++i) {
    // A float of a scan's extent: 0.1 m / 2^24.
    EXPECT_NEAR(p_m[3 * i] + block.head["trajectory"]["origin_m"][0].get<double>(), motion.p_world_tip_m[i].x(), 1e-8);
  }
  EXPECT_EQ(block.arrays.at("trajectory_contact").size(), motion.size());
  EXPECT_EQ(block.arrays.at("compliance_ratio").size(), result.compliance.windows.size());
  EXPECT_EQ(block.arrays.at("compared_s_m").size(), result.accuracy->heights.s_m.size());
}

TEST(MeasuredBlock, EveryFigureIsThatOfResultJson) {
  const ReadBlock block = block_of(process_recording(scan(), {}));
  const std::map<std::string, double> factors{{"mm", 1e3}, {"µm", 1e6},   {"mm/s", 1e3}, {"%", 100.0},
                                              {"ms", 1e3}, {"µm/N", 1e3}, {"µs", 1e6},   {"mrad", 1e3}};
  std::size_t compared = 0;
  for (const Json& metric : block.head["figures"]) {
    const std::string key = metric["key"].text(), unit = metric["unit"].text();
    EXPECT_FALSE(metric["label"].get<std::string>().empty());
    if (key.empty() || !metric["value"].is_number()) continue;
    const Json& original = at(block.head["result"], key);
    // Those that have the unit in the file, too, are not scaled.
    const bool as_it_is = key.ends_with("_um") || key.ends_with("_mm") || key.ends_with("percent");
    const double factor = as_it_is || !factors.contains(unit) ? 1.0 : factors.at(unit);
    EXPECT_NEAR(metric["value"].get<double>(), factor * original.get<double>(), 1e-9 * std::abs(factor)) << key;
    ++compared;
  }
  EXPECT_GT(compared, 40U);
}

TEST(MeasuredBlock, LongOnesAreThinnedAsTheHeadSays) {
  const ProcessResult result = process_recording(scan(), {});
  MeasuredBlockConfig config;
  config.max_trajectory_points = 100;
  config.max_profile_points = 70;
  const ReadBlock block = block_of(result, config);
  const Json& trajectory = block.head["trajectory"];
  EXPECT_LE(trajectory["points"].get<std::size_t>(), 100U);
  const auto every = trajectory["every"].get<std::size_t>();
  EXPECT_EQ((result.trajectory.motion.size() + every - 1) / every, trajectory["points"].get<std::size_t>());
  const auto& t_s = block.arrays.at("trajectory_t_s");
  EXPECT_NEAR(t_s[1],
              1e-9 * static_cast<double>(result.trajectory.motion.t_ns[every] - result.trajectory.motion.t_ns[0]),
              1e-12);
  EXPECT_LE(block.arrays.at("profile_texture_m").size(), 70U);
}

TEST(MeasuredBlock, GapsSayWhy) {
  ProcessResult result = process_recording(scan(), {});
  ASSERT_EQ(result.coverage.gaps, 0U);
  Profile& profile = result.profile;
  const std::size_t middle = profile.size() / 2;
  for (std::size_t i = middle; i < middle + 40; ++i) profile.height_m[i] = NAN;
  result.coverage.gaps = 1;
  for (std::size_t i = 0; i < result.base.contact.size(); ++i) {
    if (result.base.path.s_m[i] > profile.s_m[middle] && result.base.path.s_m[i] < profile.s_m[middle + 40])
      result.base.contact[i] = 0;
  }
  const ReadBlock block = block_of(result);
  ASSERT_EQ(block.head["gaps"].size(), 1U);
  EXPECT_EQ(block.head["gap_count"], 1U);
  EXPECT_EQ(block.head["gaps"][0]["why"], "the tip did not touch");
  EXPECT_NEAR(block.head["gaps"][0]["from_m"].get<double>(), profile.s_m[middle - 1], 1e-12);
  EXPECT_NEAR(block.head["gaps"][0]["to_m"].get<double>(), profile.s_m[middle + 40], 1e-12);
}

TEST(MeasuredBlock, ByEitherMethodAndWithoutAProfile) {
  ProcessConfig config;
  config.method = ProcessMethods::method<ThesisMethod>();
  const ReadBlock thesis = block_of(process_recording(scan(), config));
  EXPECT_TRUE(std::isnan(thesis.arrays.at("profile_sigma_m").at(10)));
  EXPECT_TRUE(std::isnan(thesis.arrays.at("trajectory_sigma_m").at(10)));
  config = {};
  config.base.shape = PathShape::kMesh;
  const ReadBlock none = block_of(process_recording(scan(), config));
  EXPECT_EQ(none.head["result"]["trustworthy"], false);
  EXPECT_TRUE(none.arrays.at("profile_height_m").empty());
  EXPECT_TRUE(none.arrays.at("base_p_m").empty());
  EXPECT_FALSE(none.arrays.at("trajectory_p_m").empty());
}

TEST(MeasuredBlock, TheSpectrumIsThatOfTheHoles) {
  const ReadBlock block = block_of(process_recording(scan(), {}));
  const auto& density = block.arrays.at("spectrum_density_m2_mm");
  const auto& frequency = block.arrays.at("spectrum_cycles_per_mm");
  const auto peak = static_cast<std::size_t>(std::max_element(density.begin(), density.end()) - density.begin());
  EXPECT_NEAR(frequency.at(peak), 1.0 / 2.5, 1.5 / 25.6);  // a hole each 2.5 mm, by segments of 25.6 mm
  EXPECT_LT(block.arrays.at("spectrum_low_m2_mm").at(peak), density.at(peak));
  EXPECT_GT(block.arrays.at("spectrum_high_m2_mm").at(peak), density.at(peak));
}

}  // namespace
}  // namespace asperity::studio
