#include "asperity/verdict/verdict.h"

#include <algorithm>

namespace asperity {

namespace {

bool has(const Verdicts& verdicts, Severity severity) {
  return std::any_of(verdicts.begin(), verdicts.end(), [&](const Verdict& v) { return v.severity == severity; });
}

}  // namespace

bool is_trustworthy(const Verdicts& verdicts) { return !has(verdicts, Severity::kInvalid); }

std::string_view verdict_word(const Verdicts& verdicts) {
  if (has(verdicts, Severity::kInvalid)) return "invalid";
  return has(verdicts, Severity::kLimited) ? "limited" : "valid";
}

std::string verdict_text(const Verdict& verdict) {
  return verdict.remedy.empty() ? verdict.message : verdict.message + "; " + verdict.remedy;
}

std::string verdict_line(const Verdict& verdict) {
  return std::string(kSeverityNames.at(static_cast<std::size_t>(verdict.severity))) + ": " + verdict_text(verdict) +
         " (asperity help " + verdict.code + ")";
}

std::string verdict_sentence(const Verdicts& verdicts) {
  const std::string_view word = verdict_word(verdicts);
  if (word == "valid") return {};
  const Severity severity = word == "invalid" ? Severity::kInvalid : Severity::kLimited;
  std::string out;
  for (const Verdict& verdict : verdicts) {
    if (verdict.severity != severity) continue;
    out += out.empty() ? std::string(word) + ": " : ". ";
    out += verdict_text(verdict);
  }
  return out;
}

void append_verdicts(Verdicts& verdicts, const Verdicts& more, std::string_view name) {
  for (Verdict verdict : more) {
    verdict.message = std::string(name) + ": " + verdict.message;
    verdicts.push_back(std::move(verdict));
  }
}

void sort_verdicts(Verdicts& verdicts) {
  std::stable_sort(verdicts.begin(), verdicts.end(),
                   [](const Verdict& a, const Verdict& b) { return a.severity < b.severity; });
}

}  // namespace asperity
