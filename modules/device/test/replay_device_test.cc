#include "asperity/device/replay_device.h"

#include <fstream>
#include <limits>

#include <gmock/gmock.h>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/device/read_replay_csv.h"
#include "asperity/testkit/count_allocations.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {

namespace {

std::vector<ReplaySample> random_samples(std::size_t count) {
  Random random(3);
  std::vector<ReplaySample> samples(count);
  std::int64_t t_ns = -12'345'678'901;
  for (ReplaySample& sample : samples) {
    sample = {t_ns, {random.normal(), random.normal(), random.normal()}};
    t_ns += 1 + static_cast<std::int64_t>(random.uniform(0.0, 5e6));
  }
  return samples;
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class ReadReplayCsv : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) {
    auto path = folder_ / "t.csv";
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  std::string refusal(const std::string& text) {
    const auto path = file(text);
    return error_of([&] { read_replay_csv(path); });
  }
  testkit::TempDir folder_;
};

}  // namespace

TEST(ReplayDevice, IsExactlyAtItsSamplesAndLinearBetween) {
  const auto samples = random_samples(200);
  const auto device = open_replay(samples);
  std::uint64_t before = 0;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const std::int64_t t_ns = samples[i].t_ns - samples[0].t_ns;
    const DeviceReading at = device->read(t_ns);
    EXPECT_EQ(at.p_m, samples[i].p_m);
    EXPECT_EQ(at.status, DeviceStatus::kReady);
    EXPECT_GT(at.sequence, before);
    before = at.sequence;
    const std::int64_t span_ns = samples[i + 1].t_ns - samples[i].t_ns;
    const Eigen::Vector3d way_m = samples[i + 1].p_m - samples[i].p_m;
    EXPECT_NEAR((at.v_mps * static_cast<double>(span_ns) * 1e-9 - way_m).norm(), 0.0, 1e-14);
    if (span_ns < 4) continue;
    device->write({1.0, 2.0, 3.0});
    const std::int64_t quarter_ns = span_ns / 4;
    const DeviceReading between = device->read(t_ns + quarter_ns);
    const double x = static_cast<double>(quarter_ns) / static_cast<double>(span_ns);
    EXPECT_NEAR((between.p_m - ((1.0 - x) * samples[i].p_m + x * samples[i + 1].p_m)).norm(), 0.0, 1e-14);
    before = between.sequence;
  }
  const std::int64_t end_ns = samples.back().t_ns - samples[0].t_ns;
  const DeviceReading last = device->read(end_ns);
  EXPECT_EQ(last.p_m, samples.back().p_m);
  EXPECT_EQ(last.v_mps, Eigen::Vector3d::Zero());
  EXPECT_EQ(last.status, DeviceStatus::kReady);
  const DeviceReading after = device->read(end_ns + 1);
  EXPECT_EQ(after.p_m, samples.back().p_m);
  EXPECT_EQ(after.status, DeviceStatus::kEnded);
}

TEST(ReplayDevice, ASingleSampleIsAPath) {
  const auto device = open_replay({{77, {1, 2, 3}}});
  EXPECT_EQ(device->read(0).status, DeviceStatus::kReady);
  EXPECT_EQ(device->read(1).status, DeviceStatus::kEnded);
  EXPECT_EQ(device->read(2).p_m, Eigen::Vector3d(1, 2, 3));
}

TEST(ReplayDevice, KnowsItsWorkspace) {
  const auto device = open_replay({{0, {1, -2, 3}}, {1, {-1, 2, 3}}});
  EXPECT_EQ(device->info().workspace_min_m, Eigen::Vector3d(-1, -2, 3));
  EXPECT_EQ(device->info().workspace_max_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(device->info().simulated);
}

TEST(ReplayDevice, EndsWhenClosed) {
  const auto device = open_replay(random_samples(10));
  EXPECT_EQ(device->read(0).status, DeviceStatus::kReady);
  device->close();
  EXPECT_EQ(device->read(1).status, DeviceStatus::kEnded);
}

TEST(ReplayDevice, TicksDoNotAllocate) {
  const auto device = open_replay(random_samples(1000));
  const std::size_t before = testkit::count_allocations();
  for (std::int64_t t_ns = 0; t_ns < 3'000'000'000; t_ns += 1'000'000) {
    device->write(device->read(t_ns).p_m);
  }
  EXPECT_EQ(testkit::count_allocations(), before);
}

TEST(ReplayDevice, RefusesWhatIsNoPath) {
  EXPECT_THROW(open_replay({}), Error);
  EXPECT_THROW(open_replay({{5, {0, 0, 0}}, {4, {0, 0, 0}}}), Error);
  EXPECT_THROW(open_replay({{5, {0, 0, std::numeric_limits<double>::infinity()}}}), Error);
  EXPECT_THROW(open_replay({{std::numeric_limits<std::int64_t>::min(), {0, 0, 0}}}), Error);
}

TEST_F(ReadReplayCsv, ReadsATrajectory) {
  const auto read =
      read_replay_csv(file("t_ns,px_m,py_m,pz_m,qw,qx,qy,qz,vx_mps,vy_mps,vz_mps,sigma_m\n"
                           "1000,0.25,-0.5,1e-3,1,0,0,0,0,0,0,nan\n"
                           "2500,0.5,-0.25,2e-3,1,0,0,0,0,0,0,nan\n"));
  ASSERT_EQ(read.samples.size(), 2u);
  EXPECT_EQ(read.samples[0].t_ns, 1000);
  EXPECT_EQ(read.samples[1].t_ns, 2500);
  EXPECT_EQ(read.samples[1].p_m, Eigen::Vector3d(0.5, -0.25, 2e-3));
  EXPECT_TRUE(read.problems.empty());
}

TEST_F(ReadReplayCsv, ReadsSecondsAndRowsWithoutTime) {
  const auto timed = read_replay_csv(file("px_m,py_m,pz_m,t_s\n1,2,3,0.5\n1,2,3,0.5004\n"));
  EXPECT_EQ(timed.samples[0].t_ns, 500'000'000);
  EXPECT_EQ(timed.samples[1].t_ns, 500'400'000);
  const auto untimed = read_replay_csv(file("px_m,py_m,pz_m\n1,2,3\nnan,nan,nan\n4,5,6"));
  ASSERT_EQ(untimed.samples.size(), 2u);
  EXPECT_EQ(untimed.samples[1].t_ns, 2'000'000);
  ASSERT_EQ(untimed.problems.size(), 1u);
  EXPECT_EQ(untimed.problems[0].kind, "no_position");
}

TEST_F(ReadReplayCsv, RefusalsNameFileLineAndValue) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal("t_ns,px_m,py_m\n1,2,3\n"), HasSubstr("pz_m"));
  EXPECT_THAT(refusal("t_ns,px_m,py_m,pz_m\n"), HasSubstr("no row"));
  EXPECT_THAT(refusal("t_ns,px_m,py_m,pz_m\n1,nan,nan,nan\n"), HasSubstr("no row"));
  EXPECT_THAT(refusal("t_ns,px_m,py_m,pz_m\n1,2,3,4\n1,2,3,4\n"),
              testing::AllOf(HasSubstr("t.csv:3"), HasSubstr("t_ns"), HasSubstr("'1'")));
  EXPECT_THAT(refusal("t_ns,px_m,py_m,pz_m\n1,2,x,4\n"), testing::AllOf(HasSubstr("t.csv:2"), HasSubstr("py_m")));
  EXPECT_THAT(refusal("t_ns,px_m,py_m,pz_m\n1,2,inf,4\n"), HasSubstr("py_m"));
  EXPECT_THAT(refusal("t_ns,px_m,py_m,pz_m\n9223372036854775807,2,1,4\n"), HasSubstr("9223372036854775807"));
  EXPECT_THAT(refusal("t_s,px_m,py_m,pz_m\nnan,2,1,4\n"), HasSubstr("t_s"));
  EXPECT_THAT(refusal("t_s,px_m,py_m,pz_m\n1e300,2,1,4\n"), HasSubstr("1e300"));
  EXPECT_THAT(error_of([] { read_replay_csv("/nonexistent/x.csv"); }), HasSubstr("x.csv"));
}

}  // namespace asperity
