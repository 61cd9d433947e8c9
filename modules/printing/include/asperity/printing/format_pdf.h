#pragma once

#include <span>
#include <string>
#include <string_view>

#include "asperity/printing/print_page.h"

namespace asperity {

// The pages as a PDF of vectors at true scale, the same bytes for the same pages: its user space is in mm from the top
// left (a page's content begins with the one matrix that makes it so), numbers to the nanometre, the black rectangles
// of a page in one path, so that no viewer draws seams between them. It begins with "%PDF-1.7\n%asperity\n", and asks
// viewers not to scale when they print. Throws Error for a page that is not 10 to 2000 mm a side, or a number that is
// not finite.
std::string format_pdf(std::span<const PrintPage> pages, std::string_view title);

}  // namespace asperity
