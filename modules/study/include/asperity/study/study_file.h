#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "asperity/json/json.h"
#include "asperity/study/study.h"

namespace asperity {

inline constexpr std::string_view kStudyFormat = "asperity.study";
inline constexpr int kStudyVersion = 1;
inline constexpr std::string_view kStudyEnding = ".study.json";
inline constexpr std::uint64_t kLargestStudy_bytes = std::uint64_t{1} << 20U;

// A study as JSON, all keys in the same order, without format and version.
Json study_json(const Study& study);

// Takes it apart; keys that are left out have the default. Throws Error naming `where`, key and value: unknown, of
// another type, out of range, too long or too many.
Study read_study(const Json& value, const std::string& where);

// JSON from a file or a line of one, of bounded size and depth, no key twice. Throws Error naming `where`.
Json parse_study_text(std::string_view text, const std::string& where);

// The content of a *.study.json. Throws Error naming `name`; StudyError for what is no study, or one of another
// version.
Study parse_study_file(std::string_view text, const std::string& name);
// The same back.
std::string format_study_file(const Study& study);

// Throws StudyError unless `code` is 1 to 40 letters, digits, `_` and `-`: it becomes part of a file's name.
void check_participant(const std::string& code);

}  // namespace asperity
