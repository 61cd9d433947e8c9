#include "asperity_firmware/request.h"

#include <gmock/gmock.h>
#include <vector>

#include "asperity/base/random.h"
#include "reference_decoder.h"

namespace asperity {
namespace {

using Bytes = std::vector<std::uint8_t>;

int requests_in(asp_request_reader& reader, const Bytes& bytes) {
  int count = 0;
  for (const std::uint8_t byte : bytes) count += asp_request_put(&reader, byte) ? 1 : 0;
  return count;
}

const Bytes& request() {
  static const Bytes frame = reference::frame_of(Bytes{0x01, 0x81});
  return frame;
}

TEST(FirmwareRequest, IsHeard) {
  asp_request_reader reader{};
  EXPECT_EQ(requests_in(reader, request()), 1);
  EXPECT_EQ(requests_in(reader, request()), 1);
}

TEST(FirmwareRequest, IsHeardAfterAnyNoise) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    asp_request_reader reader{};
    Bytes noise(static_cast<std::size_t>(random.uniform() * 300.0));
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random.uniform() * 256.0);
    ASSERT_EQ(requests_in(reader, noise), 0);
    asp_request_put(&reader, 0);
    ASSERT_EQ(requests_in(reader, request()), 1);
  }
}

TEST(FirmwareRequest, IsNotHeardFromAnotherFrame) {
  asp_request_reader reader{};
  for (const Bytes& payload : {Bytes{0x02, 0x81}, Bytes{0x01, 0x82}, Bytes{0x01, 0x81, 0x00}, Bytes{0x01, 0x81, 0x01},
                               Bytes{0x01, 0x00}, Bytes{0x00, 0x81}, Bytes{0x81, 0x01}, Bytes(300, 0x81)}) {
    EXPECT_EQ(requests_in(reader, reference::frame_of(payload)), 0);
  }
  EXPECT_EQ(requests_in(reader, request()), 1);
}

TEST(FirmwareRequest, IsNotHeardDamaged) {
  for (std::size_t at = 0; at + 1 < request().size(); ++at) {
    for (int flip = 1; flip < 256; ++flip) {
      Bytes damaged = request();
      damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ flip);
      asp_request_reader reader{};
      ASSERT_EQ(requests_in(reader, damaged), 0) << at << ' ' << flip;
    }
  }
}

}  // namespace
}  // namespace asperity
