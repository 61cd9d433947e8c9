#include "asperity/calibration/calibration_verdict.h"

#include <cctype>

#include "asperity/verdict/verdict_codes.h"

namespace asperity {

void CalibrationVerdict::add(std::string_view code, const std::string& message) {
  const Verdict& verdict = verdicts.emplace_back(make_verdict(code, message));
  trustworthy = is_trustworthy(verdicts);
  if (verdict.severity == Severity::kNote) return;
  std::string sentence = verdict_text(verdict) + ".";
  if (!sentence.empty()) sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
  text += (text.empty() ? "" : " ") + sentence;
}

}  // namespace asperity
