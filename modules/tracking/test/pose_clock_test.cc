#include "asperity/tracking/open_pose_stream.h"

#include <gmock/gmock.h>
#include <cmath>
#include <cstring>
#include <deque>

#include "asperity/base/random.h"

namespace asperity {
namespace {

using std::chrono::milliseconds;

// Datagrams with the times at which they come.
class PlayedDatagrams final : public ByteSource {
 public:
  explicit PlayedDatagrams(std::deque<std::pair<std::int64_t, std::string>> datagrams)
      : datagrams_(std::move(datagrams)) {}
  Arrival read(std::span<std::uint8_t> into, milliseconds) override {
    if (datagrams_.empty()) throw LinkLost("played: at its end");
    const auto [t_ns, bytes] = datagrams_.front();
    datagrams_.pop_front();
    std::memcpy(into.data(), bytes.data(), bytes.size());
    return {bytes.size(), t_ns};
  }
  bool write(std::span<const std::uint8_t>) override { return false; }
  std::string name() const override { return "played"; }

 private:
  std::deque<std::pair<std::int64_t, std::string>> datagrams_;
};

// A sender at 120 Hz whose clock is 100 ppm fast, over a link that is 1 to 6 ms late: its times, without that jitter.
TEST(PoseStream, TheSendersClockTakesTheLinksJitterAway) {
  Random random(5);
  std::deque<std::pair<std::int64_t, std::string>> datagrams;
  std::vector<double> true_ns;
  std::int64_t last_ns = 0;
  for (int i = 0; i < 2400; ++i) {
    const double t_ns = 1e9 + i * 1e9 / 120.0;
    const auto sender_ns = std::llround(1.7e18 + t_ns * (1.0 + 1e-4));
    last_ns = std::max<std::int64_t>(last_ns + 1, std::llround(t_ns + 1e6 + 5e6 * random.uniform()));
    datagrams.emplace_back(last_ns, std::to_string(sender_ns) + ",0,0,0,1,0,0,0\n");
    true_ns.push_back(t_ns);
  }
  const auto poses = make_pose_stream(std::make_unique<PlayedDatagrams>(datagrams), PoseTimes::kSendersClock);
  double largest_ns = 0.0;
  for (int i = 0; i < 2400; ++i) {
    const auto pose = poses->read(milliseconds(0));
    ASSERT_TRUE(pose) << i;
    // After ten seconds; the least delay of the link, 1 ms, cannot be seen.
    if (i > 1200)
      largest_ns = std::max(
          largest_ns, std::abs(static_cast<double>(pose->sample.t_ns) - true_ns[static_cast<std::size_t>(i)] - 1e6));
  }
  EXPECT_LT(largest_ns, 0.5e6);  // ns; arrival alone would be up to 5 ms off
}

TEST(PoseStream, TimesAheadOfTheHostsClockAreNoPoses) {
  const std::deque<std::pair<std::int64_t, std::string>> datagrams{
      {2'000'000'000, "4611686018427387904,0,0,0,1,0,0,0\n1990000000,0,0,0,1,0,0,0\n"}};
  const auto live = make_pose_stream(std::make_unique<PlayedDatagrams>(datagrams), PoseTimes::kHostClock);
  EXPECT_EQ(live->read(milliseconds(0)).value().sample.t_ns, 1'990'000'000);
  EXPECT_THAT(live->warnings(), testing::ElementsAre(testing::HasSubstr("ahead of this host's clock")));
  const auto file = make_pose_stream(std::make_unique<PlayedDatagrams>(datagrams));
  EXPECT_EQ(file->read(milliseconds(0)).value().sample.t_ns, std::int64_t{1} << 62);
}

TEST(PoseStream, ANewClockOfTheSenderIsNoLeapInTime) {
  std::deque<std::pair<std::int64_t, std::string>> datagrams;
  for (int i = 0; i < 200; ++i) {
    const std::int64_t sender_ns = i < 100 ? 50'000'000'000 + i * 10'000'000LL : i * 10'000'000LL;
    datagrams.emplace_back(1'000'000'000 + i * 10'000'000LL, std::to_string(sender_ns) + ",0,0,0,1,0,0,0\n");
  }
  const auto poses = make_pose_stream(std::make_unique<PlayedDatagrams>(datagrams), PoseTimes::kSendersClock);
  for (int i = 0; i < 200; ++i) {
    const auto pose = poses->read(milliseconds(0));
    ASSERT_TRUE(pose) << i;
    EXPECT_NEAR(static_cast<double>(pose->sample.t_ns), 1e9 + i * 1e7, 1e5) << i;  // ns
  }
}

}  // namespace
}  // namespace asperity
