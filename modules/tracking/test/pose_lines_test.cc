#include "asperity/tracking/pose_lines.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string_view>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/testkit/udp_sender.h"
#include "asperity/tracking/open_pose_stream.h"

namespace asperity {
namespace {

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(PoseLines, ReadsLinesOfATrackerCsvInAnyPieces) {
  constexpr std::string_view kText =
      "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz\n# comment\n\n100,0.1,-0.2,3e-1,1,0,0,0\r\n,0,0,0,0,0.6,0,-0.8,3,0.25,more\n";
  for (std::size_t piece = 1; piece < kText.size(); piece += 7) {
    PoseLines lines;
    std::vector<TrackerSample> poses;
    for (std::size_t i = 0; i < kText.size(); i += piece) lines.push(bytes_of(kText.substr(i, piece)), 555, poses);
    EXPECT_EQ(lines.bad_lines(), 0u);
    ASSERT_EQ(poses.size(), 2u);
    EXPECT_EQ(poses[0].t_ns, 100);
    EXPECT_EQ(poses[0].T_world_marker.translation_m, Eigen::Vector3d(0.1, -0.2, 0.3));
    EXPECT_EQ(poses[0].markers, 0);
    EXPECT_EQ(poses[1].t_ns, 555);  // of its arrival
    EXPECT_EQ(poses[1].T_world_marker.rotation.z(), -0.8);
    EXPECT_EQ(poses[1].markers, 3);
    EXPECT_EQ(poses[1].reprojection_px, 0.25);
  }
}

TEST(PoseLines, ALineMayBeginWithABodysName) {
  constexpr std::string_view kText =
      "object,100,0.1,0,0.3,1,0,0,0\n100,0.2,0,0.3,1,0,0,0\nobjects,101,0.1,0,0.3,1,0,0,0\ntable,102,0.4,0,0.3,1,0,0,"
      "0\n";
  PoseLines lines({"table", "object"});
  std::vector<TrackerSample> poses;
  lines.push(bytes_of(kText), 1, poses);
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[0].body, 2u);
  EXPECT_EQ(poses[1].body, 0u);
  EXPECT_EQ(poses[2].body, 1u);
  EXPECT_EQ(poses[2].T_world_marker.translation_m.x(), 0.4);
  EXPECT_EQ(lines.bad_lines(), 1u);  // a name that was not announced
  PoseLines none;
  std::vector<TrackerSample> plain;
  none.push(bytes_of(kText), 1, plain);
  EXPECT_EQ(plain.size(), 1u);
  EXPECT_EQ(none.bad_lines(), 3u);
}

TEST(PoseLines, CountsWhatIsNoPose) {
  PoseLines lines;
  std::vector<TrackerSample> poses;
  lines.push(
      bytes_of("1,2,3\n1,0,0,0,1,0,0,x\n1,nan,0,0,1,0,0,0\n1,0,0,0,2,0,0,0\n-5,0,0,0,1,0,0,0\n1,1e9,0,0,1,0,0,0\n"), 0,
      poses);
  EXPECT_EQ(lines.bad_lines(), 6u);
  lines.push(bytes_of(std::string(100'000, '1') + "\n"), 0, poses);
  EXPECT_EQ(lines.bad_lines(), 7u);
  EXPECT_TRUE(poses.empty());
  lines.push(bytes_of("1,0,0,0,1,0,0,0,2,inf\n"), 0, poses);
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_TRUE(std::isnan(poses[0].reprojection_px));
}

TEST(PoseLines, SurvivesAnyBytes) {
  Random random(11);
  PoseLines lines;
  std::vector<TrackerSample> poses;
  std::vector<std::uint8_t> noise(200'000);
  constexpr std::string_view kLetters = "0123456789.,-e\n\r#nt_";
  for (auto& byte : noise) {
    byte = random.chance(0.9) ? static_cast<std::uint8_t>(kLetters[random.bits() % kLetters.size()])
                              : static_cast<std::uint8_t>(random.bits() % 256);
  }
  lines.push(noise, 1, poses);
  for (const auto& pose : poses) EXPECT_NEAR(pose.T_world_marker.rotation.norm(), 1.0, 1e-12);
}

TEST(PoseAddress, ReadsWhatPeopleType) {
  EXPECT_EQ(parse_pose_address("udp:9000").port, 9000);
  EXPECT_EQ(parse_pose_address("udp:127.0.0.1:9000").address, "127.0.0.1");
  EXPECT_EQ(parse_pose_address("udp:[::1]:9000").address, "::1");
  EXPECT_EQ(parse_pose_address("file:a:b.csv").path, "a:b.csv");
  EXPECT_EQ(parse_pose_address("pipe:poses.fifo").kind, PoseAddress::Kind::kPipe);
  for (const char* wrong : {"", "udp", "udp:", "udp:0", "udp:70000", "udp::9000", "vrpn:x", "file:"}) {
    EXPECT_THROW(parse_pose_address(wrong), Error) << wrong;
  }
}

TEST(PoseStream, OverUdpIsOfTheFirstWhoSendsAPose) {
  using namespace std::chrono_literals;
  const auto poses = open_pose_stream(PoseAddress{});
  EXPECT_THAT(poses->name(), testing::HasSubstr("udp:127.0.0.1:"));
  const int port = testkit::port_in(poses->name());
  const testkit::UdpSender stranger;
  const testkit::UdpSender tracker;
  stranger.send_text(port, "1,2,3\n");
  stranger.send_text(port, "1,nan,0,0,1,0,0,0\n");
  tracker.send_text(port, "1000000,0.1,0,0,1,0,0,0\n");
  stranger.send_text(port, "2000000,0.9,0,0,1,0,0,0\n");
  tracker.send_text(port, "2000000,0.2,0,0,1,0,0,0\n");
  EXPECT_EQ(poses->read(20s)->sample.T_world_marker.translation_m.x(), 0.1);
  EXPECT_EQ(poses->read(20s)->sample.T_world_marker.translation_m.x(), 0.2);
}

}  // namespace
}  // namespace asperity
