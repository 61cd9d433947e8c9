#include "asperity/recording/fingerprint.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/json/parse_json.h"
#include "asperity/recording/cut_recording.h"

namespace asperity {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::int64_t kProbeStep_ns = 400'000, kPoseStep_ns = 10'000'000;

// 4 s of counts and poses with noise of their own.
Recording noisy_recording(std::uint64_t seed) {
  Random random(seed, 5);
  Recording out;
  for (std::int64_t i = 0; i < 10000; ++i) {
    out.probe.t_ns.push_back(i * kProbeStep_ns);
    const auto counts = [&] { return std::round(2000.0 + 3.0 * random.normal()); };
    out.probe.accel_counts.emplace_back(counts(), counts(), counts());
    out.probe.force_counts.push_back(counts());
  }
  for (std::int64_t i = 0; i < 400; ++i) {
    out.tracker.t_ns.push_back(i * kPoseStep_ns);
    Pose pose;
    pose.translation_m = {1e-4 * random.normal(), 1e-4 * random.normal(), 0.3 + 1e-4 * random.normal()};
    pose.rotation = Eigen::Quaterniond(1.0, 1e-3 * random.normal(), 0.2, 1e-3 * random.normal()).normalized();
    out.tracker.T_world_marker.push_back(pose);
  }
  return out;
}

// Written and read with other digits, at other times, in another world, under other names.
Recording saved_again(Recording recording) {
  recording.info.object = "another";
  for (std::int64_t& t_ns : recording.probe.t_ns) t_ns += 123'456'789;
  for (std::int64_t& t_ns : recording.tracker.t_ns) t_ns += 123'456'789;
  for (Pose& pose : recording.tracker.T_world_marker) {
    pose.translation_m += Eigen::Vector3d(0.1, 0.0, 0.0);
    pose.rotation.coeffs() *= -1.0;
  }
  return recording;
}

TEST(Fingerprint, ACopyIsOneMeasurementWhateverItsMetadata) {
  const Recording a = noisy_recording(1);
  const Fingerprint of_a = fingerprint_of(a), of_copy = fingerprint_of(saved_again(a));
  EXPECT_EQ(shared_share(of_a.probe, of_copy.probe), 1.0);
  EXPECT_EQ(shared_share(of_a.poses, of_copy.poses), 0.0);  // of another world
  EXPECT_THAT(
      [&] {
        check_independent(std::vector<NamedFingerprint>{{"a", of_a}, {"copy", of_copy}});
      },
      ThrowsMessage<Error>(AllOf(HasSubstr("a and copy have 100 % of their samples"), HasSubstr("leave one"))));
  const Fingerprint of_b = fingerprint_of(noisy_recording(2));
  EXPECT_EQ(shared_share(of_a.probe, of_b.probe), 0.0);
  EXPECT_EQ(shared_share(of_a.poses, of_b.poses), 0.0);
  check_independent(std::vector<NamedFingerprint>{{"a", of_a}, {"b", of_b}});
}

TEST(Fingerprint, SameCountsWithOtherPosesAndSamePosesWithOtherCountsAreRefused) {
  const Recording a = noisy_recording(1);
  Recording b = noisy_recording(2);
  b.tracker = a.tracker;
  EXPECT_THAT(
      [&] {
        check_independent(std::vector<NamedFingerprint>{{"a", fingerprint_of(a)}, {"b", fingerprint_of(b)}});
      },
      ThrowsMessage<Error>(HasSubstr("poses in common")));
  for (Pose& pose : b.tracker.T_world_marker) pose.rotation.coeffs() *= -1.0;
  EXPECT_EQ(shared_share(fingerprint_of(a).poses, fingerprint_of(b).poses), 1.0);
}

TEST(Fingerprint, ACropIsFoundAndCutsThatMeetAreNot) {
  const Recording a = noisy_recording(1);
  const auto cut = [&](double from, double to) {
    return fingerprint_of(cut_recording(a, static_cast<std::int64_t>(4e9 * from), static_cast<std::int64_t>(4e9 * to)));
  };
  EXPECT_EQ(shared_share(fingerprint_of(a).probe, cut(0.4, 0.7).probe), 1.0);
  EXPECT_NEAR(shared_share(cut(0.0, 0.6).probe, cut(0.5, 1.0).probe), 0.2, 0.05);
  EXPECT_THROW(check_independent(std::vector<NamedFingerprint>{{"a", cut(0.0, 0.6)}, {"b", cut(0.5, 1.0)}}), Error);
  check_independent(std::vector<NamedFingerprint>{{"a", cut(0.0, 0.5)}, {"b", cut(0.5, 1.0)}});
}

TEST(Fingerprint, QuietSensorsAreNoCopies) {
  // A sensor that reads one value or the next, and one that is dead: nothing that two recordings could share by chance.
  const auto quiet = [](std::uint64_t seed, double noise) {
    Random random(seed, 6);
    Recording out = noisy_recording(seed);
    for (Eigen::Vector3d& counts : out.probe.accel_counts)
      counts = {noise * (random.chance(0.5) ? 1.0 : 0.0), 7.0, 9.0};
    for (double& counts : out.probe.force_counts) counts = 12.0;
    return fingerprint_of(out);
  };
  EXPECT_EQ(quiet(1, 0.0).probe.windows, 0U);
  EXPECT_EQ(shared_share(quiet(1, 0.0).probe, quiet(2, 0.0).probe), 0.0);
  EXPECT_LT(shared_share(quiet(1, 1.0).probe, quiet(2, 1.0).probe), 0.005);
}

TEST(Fingerprint, TheStoredSketchSeesWhatTheWholeSees) {
  const Recording a = noisy_recording(1);
  const Fingerprint whole = fingerprint_of(a);
  const Fingerprint stored = parse_fingerprint(parse_json(fingerprint_json(whole).dump()));
  EXPECT_EQ(stored.probe.windows, whole.probe.windows);
  EXPECT_EQ(stored.probe.hashes.size(), 32U);
  EXPECT_EQ(shared_share(stored.probe, whole.probe), 1.0);
  const Fingerprint half = fingerprint_of(cut_recording(a, 1'000'000'000, 3'000'000'000));
  EXPECT_EQ(shared_share(stored.probe, half.probe), 1.0);
  EXPECT_EQ(shared_share(stored.probe, fingerprint_of(noisy_recording(2)).probe), 0.0);
  // Parts that overlap by a fifth: the estimate from 32 hashes is that of a binomial distribution.
  const Fingerprint first = fingerprint_of(cut_recording(a, 0, 2'400'000'000));
  const Fingerprint last =
      parse_fingerprint(fingerprint_json(fingerprint_of(cut_recording(a, 2'000'000'000, 4'000'000'000))));
  EXPECT_GT(shared_share(first.probe, last.probe), 0.0);
  for (const char* text : {"{}", "null", R"({"probe": 3})", R"({"probe": {"windows": -1, "smallest": ""}})",
                           R"({"probe": {"windows": 5, "smallest": "zz00000000000000"}})",
                           R"({"probe": {"windows": 5, "smallest": "00000000000000020000000000000001"}})"}) {
    EXPECT_EQ(parse_fingerprint(parse_json(text)).probe.windows, 0U) << text;
  }
}

// The rolling hash of windows against windows compared value by value.
TEST(Fingerprint, CountsTheWindowsThatTwoTablesHaveInCommon) {
  constexpr std::size_t kWindow = 32;
  Random random(3, 7);
  std::vector<double> a(600), b;
  for (double& value : a) value = random.bits() % 3;
  b.assign(a.begin() + 200, a.begin() + 450);
  b.insert(b.begin() + 100, 5.0);
  const auto windows = [](const std::vector<double>& values) {
    std::set<std::vector<double>> out;
    for (std::size_t i = 0; i + kWindow <= values.size(); ++i)
      out.insert(
          {values.begin() + static_cast<std::ptrdiff_t>(i), values.begin() + static_cast<std::ptrdiff_t>(i + kWindow)});
    return out;
  };
  std::size_t common = 0;
  for (const auto& window : windows(b)) common += windows(a).count(window);
  ASSERT_GT(common, 100U);
  EXPECT_EQ(sketch_values(a).windows, windows(a).size());
  EXPECT_DOUBLE_EQ(shared_share(sketch_values(a), sketch_values(b)),
                   static_cast<double>(common) / static_cast<double>(windows(b).size()));
}

}  // namespace
}  // namespace asperity
