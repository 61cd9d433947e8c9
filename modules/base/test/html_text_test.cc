#include "asperity/base/html_text.h"

#include <gtest/gtest.h>

namespace asperity {
namespace {

// What a browser's parser takes for markup, by the HTML standard's list of characters to be escaped.
TEST(HtmlText, HoldsNoMarkup) {
  EXPECT_EQ(html_text("<b a=\"1\">&amp;"), "&lt;b a=&quot;1&quot;&gt;&amp;amp;");
  EXPECT_EQ(html_text(""), "");
}

TEST(HtmlText, LeavesOtherBytes) { EXPECT_EQ(html_text("µm, it's 3;\n"), "µm, it's 3;\n"); }

}  // namespace
}  // namespace asperity
