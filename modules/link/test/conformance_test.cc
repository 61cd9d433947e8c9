// test/data/protocol: streams of bytes and what a decoder must make of them (README.md there).
#include <gmock/gmock.h>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "asperity/base/csv.h"
#include "asperity/base/random.h"
#include "asperity/link/open_protocol.h"
#include "asperity/link/probe_decoder.h"

namespace asperity {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(ASPERITY_TEST_DATA) / "protocol")) {
    if (entry.path().extension() == ".bin") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

json as_json(const LinkStatistics& statistics) {
  return {{"frames", statistics.frames},
          {"samples", statistics.samples},
          {"force_samples", statistics.force_samples},
          {"lost_frames", statistics.lost_frames},
          {"lost_samples", statistics.lost_samples},
          {"damaged_frames", statistics.damaged_frames},
          {"late_frames", statistics.late_frames},
          {"foreign_frames", statistics.foreign_frames},
          {"restarts", statistics.restarts},
          {"overruns", statistics.overruns},
          {"resyncs", statistics.resyncs}};
}

// State and counts in the document's order; all zero where the file has none.
json faults_of(const LinkStatistics& statistics) {
  const ProbeFaults& f = statistics.faults;
  return {f.imu_state,        f.force_state,  f.imu_bus_failures,   f.imu_overflows, f.imu_lost_sync,
          f.imu_invalid_rows, f.imu_restarts, f.force_bus_failures, f.force_skipped, f.force_restarts};
}

json as_row(const ProbeSample& sample, bool gyro, int force_axes) {
  json row;
  for (int axis = 0; axis < 3; ++axis) row.push_back(static_cast<int>(sample.accel_counts[axis]));
  for (int axis = 0; gyro && axis < 3; ++axis) row.push_back(static_cast<int>(sample.gyro_counts[axis]));
  const auto add_force = [&](double counts) {
    row.push_back(std::isnan(counts) ? json() : json(static_cast<int>(counts)));
  };
  for (int axis = 0; force_axes == 3 && axis < 3; ++axis) add_force(sample.force3_counts[axis]);
  if (force_axes == 1) add_force(sample.force_counts);
  return row;
}

json as_json(const std::optional<ProbeDescription>& description, const json& like) {
  if (!description) return nullptr;
  json out = json::parse(format_open_description(*description));
  // Keys that were absent are written with what stands for unknown.
  for (auto it = out.begin(); it != out.end();) it = like.contains(it.key()) ? std::next(it) : out.erase(it);
  return out;
}

class Conformance : public testing::TestWithParam<std::string> {};

TEST_P(Conformance, DecoderGivesWhatTheFileSays) {
  const fs::path folder = fs::path(ASPERITY_TEST_DATA) / "protocol";
  const std::string text = read_file(folder / (GetParam() + ".bin"), 1 << 20);
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  const json expected = json::parse(read_file(folder / (GetParam() + ".json"), 1 << 20));
  Random random(3);
  // All at once, byte by byte, in random pieces.
  for (int way = 0; way < 3; ++way) {
    const auto decoder = make_probe_decoder(ProbeProtocol::kOpen);
    std::vector<ProbeSample> samples;
    std::int64_t arrival_ns = 5'000'000'000;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t size = way == 0 ? bytes.size() : way == 1 ? 1 : 1 + (random.bits() >> 57);
      const auto piece = bytes.subspan(at, std::min(size, bytes.size() - at));
      decoder->push(piece, arrival_ns, samples);
      at += piece.size();
      arrival_ns += 1'000;
    }
    EXPECT_EQ(as_json(decoder->statistics()), expected.at("statistics"));
    EXPECT_EQ(faults_of(decoder->statistics()), expected.value("faults", json(std::vector<int>(10, 0))));
    EXPECT_EQ(decoder->statistics().bytes, bytes.size());
    EXPECT_FALSE(decoder->statistics().losses_are_estimated);
    EXPECT_EQ(as_json(decoder->description(), expected.at("description")), expected.at("description"));
    json rows = json::array();
    for (const ProbeSample& sample : samples)
      rows.push_back(as_row(sample, expected.at("gyro"), expected.at("force_axes")));
    EXPECT_EQ(rows, expected.at("rows"));
    for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_LT(samples[i - 1].t_ns, samples[i].t_ns);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Conformance, testing::ValuesIn(case_names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace asperity
