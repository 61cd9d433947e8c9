#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// What a verdict means for the result: `kInvalid` that it must not be used (a command ends with code 3), `kLimited`
// that it may be used within what the message states, `kNote` that it is worth knowing.
enum class Severity : std::uint8_t { kInvalid, kLimited, kNote };
inline constexpr std::array<std::string_view, 3> kSeverityNames{"invalid", "limited", "note"};

// One judgement of a result. Codes are stable and in docs/verdicts.md.
struct Verdict {
  std::string code;  // snake_case
  Severity severity = Severity::kNote;
  std::string message;  // what was found, with numbers and units; no full stop
  std::string remedy;   // what to do, as an imperative; no full stop; may be empty

  bool operator==(const Verdict&) const = default;
};

using Verdicts = std::vector<Verdict>;

// None is invalid.
bool is_trustworthy(const Verdicts& verdicts);

// "valid", "limited" or "invalid": the worst of the list; notes change nothing.
std::string_view verdict_word(const Verdicts& verdicts);

// "message; remedy": one verdict in words, without its severity.
std::string verdict_text(const Verdict& verdict);

// "invalid: message; remedy (asperity help CODE)": one verdict as a line for a person, and where it is explained.
std::string verdict_line(const Verdict& verdict);

// The whole list as one sentence: empty for a valid result, otherwise the word and the text of each verdict of that
// severity: "invalid: message; remedy. Message; remedy".
std::string verdict_sentence(const Verdicts& verdicts);

// Those of `more` at the end of `verdicts`, their messages preceded by "name: ".
void append_verdicts(Verdicts& verdicts, const Verdicts& more, std::string_view name);

// The invalid first, then the limited, then the notes; within a severity the order stays.
void sort_verdicts(Verdicts& verdicts);

}  // namespace asperity
