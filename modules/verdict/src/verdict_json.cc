#include "asperity/verdict/verdict_json.h"

namespace asperity {

Json verdicts_json(const Verdicts& verdicts) {
  Json out = Json::array();
  for (const Verdict& verdict : verdicts) {
    out.push_back({{"code", verdict.code},
                   {"severity", kSeverityNames.at(static_cast<std::size_t>(verdict.severity))},
                   {"message", verdict.message},
                   {"remedy", verdict.remedy}});
  }
  return out;
}

}  // namespace asperity
