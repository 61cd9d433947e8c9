#pragma once

#include <string>
#include <string_view>

#include "asperity/studio/block.h"
#include "asperity/studio/project.h"
#include "study/study.h"

namespace asperity::studio {

inline constexpr std::string_view kStudyFormat = "asperity.study";
inline constexpr int kStudyVersion = 1;
inline constexpr std::string_view kStudyEnding = ".study.json";

// A study as JSON, all keys in the same order, without format and version.
Json study_json(const Study& study);

// Takes it apart; keys that are left out have the default. Throws Error naming `where`, key and value: unknown, of
// another type, out of range, too long or too many.
Study read_study(const Json& value, const std::string& where);

// JSON from a file or a line of one, of bounded size and depth, no key twice. Throws Error naming `where`.
Json parse_study_text(std::string_view text, const std::string& where);

// A *.study.json of the project. Throws Error naming the file.
Study read_study_file(const Project& project, const std::string& name);
// Its content.
std::string format_study_file(const Study& study);

// Throws Error unless `code` is 1 to 40 letters, digits, `_` and `-`: it becomes part of a file's name.
void check_participant(const std::string& code);

}  // namespace asperity::studio
