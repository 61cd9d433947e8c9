#include "asperity/image/y4m.h"

#include <gmock/gmock.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Y4m, ReadsWhatFfmpegWrites) {
  const Y4mHeader header =
      parse_y4m_header("YUV4MPEG2 W641 H481 F30000:1001 Ip A0:0 C420mpeg2 XYSCSS=420MPEG2 XCOLORRANGE=LIMITED", "in");
  EXPECT_EQ(header.width, 641);
  EXPECT_EQ(header.height, 481);
  EXPECT_EQ(header.rate_numerator, 30000);
  EXPECT_EQ(header.rate_denominator, 1001);
  EXPECT_EQ(header.luma_bytes(), 641u * 481u);
  EXPECT_EQ(header.chroma_bytes(), 2u * 321u * 241u);
}

TEST(Y4m, ChromaPlanesOfEveryKind) {
  const auto chroma = [](const std::string& kind) {
    return parse_y4m_header("YUV4MPEG2 W5 H3 F1:1 C" + kind, "in").chroma_bytes();
  };
  EXPECT_EQ(chroma("mono"), 0u);
  EXPECT_EQ(chroma("420jpeg"), 2u * 3u * 2u);
  EXPECT_EQ(chroma("411"), 2u * 2u * 3u);
  EXPECT_EQ(chroma("422"), 2u * 3u * 3u);
  EXPECT_EQ(chroma("444"), 30u);
  EXPECT_EQ(chroma("444alpha"), 45u);
  EXPECT_EQ(parse_y4m_header("YUV4MPEG2 W5 H3", "in").chroma, "420");  // the format's default
}

TEST(Y4m, RefusesWhatItCannotUse) {
  const auto message = [](const std::string& line, const std::string& part) {
    EXPECT_THAT([&] { parse_y4m_header(line, "cam"); },
                ThrowsMessage<Error>(testing::AllOf(testing::StartsWith("cam: "), HasSubstr(part))));
  };
  message("", "not a YUV4MPEG2");
  message("YUV4MPEG W5 H5", "not a YUV4MPEG2");
  message("YUV4MPEG2 W5", "no size");
  message("YUV4MPEG2 W8193 H5", "W8193");
  message("YUV4MPEG2 W0 H5", "W0");
  message("YUV4MPEG2 W-5 H5", "W-5");
  message("YUV4MPEG2 W99999999999 H5", "W99999999999");
  message("YUV4MPEG2 W5 H5 F30", "F30");
  message("YUV4MPEG2 W5 H5 F30:-1", "F30:-1");
  message("YUV4MPEG2 W5 H5 It", "interlaced");
  message("YUV4MPEG2 W5 H5 C420p10", "C420p10");
  message("YUV4MPEG2 W5 H5 Q1", "Q1");
}

TEST(Y4m, AnUnknownRateIsZero) {
  EXPECT_EQ(parse_y4m_header("YUV4MPEG2 W5 H5 F0:0", "in").rate_numerator, 0);
  EXPECT_EQ(parse_y4m_header("YUV4MPEG2 W5 H5", "in").rate_numerator, 0);
}

TEST(Y4m, FrameLines) {
  EXPECT_EQ(parse_y4m_frame_line("FRAME", "in"), std::nullopt);
  EXPECT_EQ(parse_y4m_frame_line("FRAME Ip Xother=1", "in"), std::nullopt);
  EXPECT_EQ(parse_y4m_frame_line("FRAME Xt_ns=-12", "in"), -12);
  EXPECT_EQ(parse_y4m_frame_line("FRAME Ip Xt_ns=9223372036854775807 Xa", "in"), 9223372036854775807);
  EXPECT_THAT([] { parse_y4m_frame_line("FRAME Xt_ns=1.5", "in"); }, ThrowsMessage<Error>(HasSubstr("Xt_ns=1.5")));
  EXPECT_THAT([] { parse_y4m_frame_line("FRAME Xt_ns=9223372036854775808", "in"); }, testing::Throws<Error>());
  EXPECT_THAT([] { parse_y4m_frame_line("FRAMES", "in"); }, ThrowsMessage<Error>(HasSubstr("FRAMES")));
}

TEST(Y4m, WritesBytesThatTheFormatPrescribes) {
  Y4mHeader header;
  header.width = 2;
  header.height = 2;
  header.rate_numerator = 120;
  EXPECT_EQ(format_y4m_header(header), "YUV4MPEG2 W2 H2 F120:1 Ip A1:1 Cmono\n");
  std::string out;
  append_y4m_frame(out, header, {2, 2, {'a', 'b', 'c', 'd'}}, 7);
  append_y4m_frame(out, header, {2, 2, {'e', 'f', 'g', 'h'}}, std::nullopt);
  EXPECT_EQ(out, "FRAME Xt_ns=7\nabcdFRAME\nefgh");
  EXPECT_THROW(append_y4m_frame(out, header, {1, 2, {'e', 'f'}}, 7), Error);
  header.width = 9000;
  EXPECT_THROW(format_y4m_header(header), Error);
}

}  // namespace
}  // namespace asperity
