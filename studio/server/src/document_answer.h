#pragma once

#include <filesystem>
#include <string_view>

#include "http_answer.h"

namespace asperity::studio {

// The answer for a page or file of the documents, `path` beginning with "/docs". They are of the program, as the app
// is, and may be read without a session. Their pages have scripts of their own in the text, which may connect to
// nothing. Where the documents are not installed, a page states how to get them.
HttpAnswer answer_document(std::string_view path, const std::filesystem::path& documents);

}  // namespace asperity::studio
