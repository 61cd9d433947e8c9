// Answers of a 2diy's board, each after two bytes that say how many ms later it came: only finite angles within bounds
// are believed, and what the linkage makes of them is finite. Five refused in succession are a fault.
#include <numbers>

#include "fuzz_input.h"
#include "pantograph.h"
#include "two_diy_answer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using asperity::must;
  constexpr std::size_t kBytes = asperity::kTwoDiyAnswer_bytes;
  asperity::TwoDiyAnswers answers(5);
  double t_s = 0.0;
  int refused = 0;
  for (; size >= 2 + kBytes; data += 2 + kBytes, size -= 2 + kBytes) {
    t_s += 1e-3 * (data[0] + 256.0 * data[1]);
    const auto before = answers.theta_deg();
    const auto kind = answers.take(std::span<const unsigned char, kBytes>(data + 2, kBytes), t_s);
    using Kind = asperity::TwoDiyAnswers::Kind;
    if (kind != Kind::kBelieved) {
      must(answers.theta_deg() == before);
      must((++refused >= 5) == (kind == Kind::kFault));
      continue;
    }
    refused = 0;
    must(data[2] == 5 && answers.theta_deg()->allFinite() && answers.theta_deg()->cwiseAbs().maxCoeff() <= 3600.0);
    const auto state = asperity::pantograph_state({}, *answers.theta_deg() * (std::numbers::pi / 180.0));
    must(!state || (state->p_m.allFinite() && state->p_m.norm() < 0.2 && state->jacobian_m.allFinite()));
  }
  return 0;
}
