#include "asperity/base/md5.h"

#include <cstddef>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using testing::HasSubstr;

constexpr const char* kDigits = "12345678901234567890123456789012345678901234567890123456789012345678901234567890";

// The test suite of RFC 1321, appendix A.5.
TEST(Md5, HasTheSumsOfItsStandard) {
  EXPECT_EQ(md5_hex(""), "d41d8cd98f00b204e9800998ecf8427e");
  EXPECT_EQ(md5_hex("a"), "0cc175b9c0f1b6a831c399e269772661");
  EXPECT_EQ(md5_hex("abc"), "900150983cd24fb0d6963f7d28e17f72");
  EXPECT_EQ(md5_hex("message digest"), "f96b697d7cb7938d525a2f31aaf161d0");
  EXPECT_EQ(md5_hex("abcdefghijklmnopqrstuvwxyz"), "c3fcd3d76192e4007dfb496cca67e13b");
  EXPECT_EQ(md5_hex(kDigits), "57edf4a22be3c955ac49da2e2107b67a");
}

TEST(Md5, OfPiecesIsThatOfTheWhole) {
  const std::string text = std::string(kDigits) + kDigits;
  for (std::size_t first = 0; first <= text.size(); ++first) {
    Md5 sum;
    sum.add(std::string_view(text).substr(0, first));
    sum.add("");
    for (const char one : text.substr(first)) sum.add(std::string(1, one));
    EXPECT_EQ(sum.hex(), md5_hex(text)) << first;
  }
}

TEST(Md5, OfAFileIsThatOfItsBytes) {
  const testkit::TempDir folder;
  // Around the pieces in which a file is read.
  for (const std::size_t bytes : {0UL, 1UL, 65535UL, 65536UL, 65537UL, 200000UL}) {
    std::string content(bytes, 'x');
    for (std::size_t i = 0; i < bytes; ++i) content[i] = static_cast<char>(i * i + i / 7);
    write_file(folder / "file", content);
    EXPECT_EQ(md5_hex_of_file(folder / "file", bytes), md5_hex(content)) << bytes;
  }
  EXPECT_THAT([&] { md5_hex_of_file(folder / "file", 199999); }, testing::ThrowsMessage<Error>(HasSubstr("199999")));
  EXPECT_THAT([&] { md5_hex_of_file(folder / "none", 1); }, testing::ThrowsMessage<Error>(HasSubstr("no such file")));
  EXPECT_THAT([&] { md5_hex_of_file(folder.path(), 1); },
              testing::ThrowsMessage<Error>(HasSubstr("not a regular file")));
}

}  // namespace
}  // namespace asperity
