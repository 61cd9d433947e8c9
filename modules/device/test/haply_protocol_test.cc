#include "../src/haply_protocol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using testing::HasSubstr;

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

const std::string kFrame =
    R"({"session_id":7,"inverse3":[
      {"device_id":"049D","config":{"type":"inverse3x"},"status":{},"state":{
        "cursor_position":{"x":0.01,"y":-0.12,"z":0.15},"cursor_velocity":{"x":1,"y":-2,"z":0.5}}},
      {"device_id":"04BA","status":{},"state":{
        "cursor_position":{"x":1,"y":2,"z":3},"cursor_velocity":{"x":0,"y":0,"z":0}}}]})";

TEST(HaplyProtocol, ReadsTheFirstOrTheNamedDevice) {
  const HaplyState first = parse_haply_frame(kFrame, "");
  EXPECT_EQ(first.device_id, "049D");
  EXPECT_EQ(first.model, "inverse3x");
  EXPECT_EQ(first.p_m, Eigen::Vector3d(0.01, -0.12, 0.15));
  EXPECT_EQ(first.v_mps, Eigen::Vector3d(1.0, -2.0, 0.5));
  EXPECT_EQ(parse_haply_frame(kFrame, "04BA").p_m, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_THAT(message_of([] { parse_haply_frame(kFrame, "FFFF"); }),
              HasSubstr("'FFFF' is not in the service's list (049D, 04BA)"));
}

TEST(HaplyProtocol, RefusesWhatIsNotAFrame) {
  const auto refused = [](const std::string& text) { return message_of([&] { parse_haply_frame(text, "049D"); }); };
  EXPECT_THAT(refused(""), HasSubstr("not JSON"));
  EXPECT_THAT(refused("garbage\x01\xff"), HasSubstr("haply:1:1: not JSON: syntax error"));
  EXPECT_THAT(refused(kFrame.substr(0, 100)), HasSubstr("not JSON"));
  EXPECT_THAT(refused("[]"), HasSubstr("is gone"));
  EXPECT_THAT(refused("7"), HasSubstr("is gone"));
  EXPECT_THAT(refused(R"({"inverse3":{}})"), HasSubstr("is gone"));
  EXPECT_THAT(refused(R"({"inverse3":[]})"), HasSubstr("is gone"));
  EXPECT_THAT(refused(R"({"inverse3":[7,null,{"device_id":1}]})"), HasSubstr("not in the service's list"));
  EXPECT_THAT(refused(R"({"inverse3":[{"device_id":"049D"}]})"), HasSubstr("has no state"));
  EXPECT_THAT(refused(R"({"inverse3":[{"device_id":"049D","state":[]}]})"), HasSubstr("no number cursor_position.x"));
  EXPECT_THAT(refused(std::string(20, '[') + std::string(20, ']')), HasSubstr("nested more than 16 deep"));
  EXPECT_THAT(refused(std::string(300000, '[')), HasSubstr("a frame of 300000 bytes, more than 262144"));
  for (const char* number : {"1e999", "11", "-1e300", "\"1\"", "null", "NaN"}) {
    std::string frame = kFrame;
    frame.replace(frame.find("0.01"), 4, number);
    EXPECT_NE(refused(frame), "no error") << number;
  }
  EXPECT_THAT(message_of([] { parse_haply_frame(R"({"inverse3":[{"device_id":"a\",\"b","state":{}}]})", ""); }),
              HasSubstr("is not a device's id"));
}

TEST(HaplyProtocol, TheVersionDecidesTheForcesName) {
  const auto key = [](const std::string& version) {
    return parse_service_version(R"({"project_name":"haply-inverse-service","project_version":")" + version + "\"}");
  };
  EXPECT_EQ(key("3.1.0.0"), HaplyForceKey::kValues);
  EXPECT_EQ(key("3.4.9.0"), HaplyForceKey::kValues);
  EXPECT_EQ(key("3.5.0.0"), HaplyForceKey::kVector);
  EXPECT_EQ(key("3.10"), HaplyForceKey::kVector);
  EXPECT_EQ(key("4.0.0"), HaplyForceKey::kVector);
  EXPECT_EQ(parse_service_version(R"({"ok":true,"data":{"git_tag":"3.1.1"}})"), HaplyForceKey::kValues);
  EXPECT_THAT(message_of([&] { key("3.0.7.0"); }), HasSubstr("3.0.7.0 is too old; 3.1 is needed"));
  for (const char* body : {"{}", "[]", "3.5", "<html>", R"({"project_version":35})", R"({"project_version":"three.5"})",
                           R"({"project_version":"3"})"}) {
    EXPECT_NE(message_of([&] { parse_service_version(body); }), "no error") << body;
  }
}

TEST(HaplyProtocol, WritesOneForceAndTheProfileOnce) {
  const Eigen::Vector3d force_N(0.1, -2.0, 1e-7);
  std::string text;
  write_haply_command(text, "049D", force_N, HaplyForceKey::kVector, true);
  const nlohmann::json first = nlohmann::json::parse(text);
  EXPECT_EQ(first.at("session").at("configure").at("profile").at("name"), "asperity");
  const auto& device = first.at("inverse3").at(0);
  EXPECT_EQ(device.at("device_id"), "049D");
  EXPECT_EQ(device.at("commands").at("set_cursor_force").at("vector").at("x").get<double>(), 0.1);
  write_haply_command(text, "049D", force_N, HaplyForceKey::kValues, false);
  const nlohmann::json next = nlohmann::json::parse(text);
  EXPECT_FALSE(next.contains("session"));
  EXPECT_EQ(next.at("inverse3").at(0).at("commands").at("set_cursor_force").at("values").at("z").get<double>(), 1e-7);
}

TEST(HaplyProtocol, AxesAreARotation) {
  const Eigen::Matrix3d R = parse_haply_axes("XZ-Y");
  const Eigen::Vector3d right(1, 0, 0), forward(0, 1, 0), up(0, 0, 1);
  EXPECT_EQ(R * right, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(R * up, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(R * forward, Eigen::Vector3d(0, 0, -1));  // away from the user
  EXPECT_EQ(parse_haply_axes("+X+Y+Z"), Eigen::Matrix3d::Identity());
  EXPECT_EQ(parse_haply_axes("YZX") * forward, right);
  for (const char* axes : {"", "X", "XY", "XZY", "XXY", "XYZX", "xyz", "X-Y", "XYZ-", "X Y Z", "--XYZ"}) {
    EXPECT_THAT(message_of([&] { parse_haply_axes(axes); }), HasSubstr("right-handed")) << axes;
  }
}

// RFC 6455, 5.2, by hand: what a server takes off again.
TEST(HaplyProtocol, AFrameIsMaskedAndWhole) {
  for (const std::size_t length : {0u, 5u, 125u, 126u, 300u}) {
    const std::string text(length, 'q');
    const std::vector<std::byte> frame = websocket_frame(text);
    const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(frame.at(i)); };
    EXPECT_EQ(at(0), 0x81u);
    EXPECT_EQ(at(1) & 0x80u, 0x80u);
    const bool is_short = length < 126;
    EXPECT_EQ(at(1) & 0x7Fu, is_short ? length : 126u);
    if (!is_short) {
      EXPECT_EQ(256u * at(2) + at(3), length);
    }
    const std::size_t key = is_short ? 2 : 4;
    ASSERT_EQ(frame.size(), key + 4 + length);
    for (std::size_t k = 0; k < length; ++k) EXPECT_EQ(at(key + 4 + k) ^ at(key + k % 4), unsigned{'q'});
  }
  EXPECT_THROW(websocket_frame(std::string(70000, 'x')), Error);
}

}  // namespace
}  // namespace asperity
