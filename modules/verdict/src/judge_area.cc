#include "asperity/verdict/judge_area.h"

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "asperity/verdict/verdict_codes.h"

namespace asperity {

namespace {

constexpr double kLeastAgreement = 0.5;  // below it a stroke has more of its own than of the surface
constexpr double kSigmas = 2.0;
constexpr double kLeastSnr = 2.0;  // of powers, as below_noise has it for one stroke
constexpr double kLeastCovered = 0.5;
constexpr double kRatioLow = 0.6, kRatioHigh = 1.5;
constexpr double kStretch = 0.1;  // lengths off by more than this part

}  // namespace

Verdicts judge_area(const AreaEvidence& e) {
  Verdicts out;
  const auto say = [&](const char* code, std::string message) {
    out.push_back(make_verdict(code, std::move(message)));
  };
  if (!e.registered) say("area_unregistered", "the registration of the strokes is invalid");
  const double low = e.agreement - kSigmas * e.agreement_sigma, high = e.agreement + kSigmas * e.agreement_sigma;
  const std::string shared = fmt::format("the strokes share {:.0f} ± {:.0f} % of their variance where they meet",
                                         100.0 * e.agreement, 100.0 * e.agreement_sigma);
  if (e.ties == 0) {
    say("strokes_untied",
        fmt::format("none of the {} stroke{} crosses another or comes near it", e.strokes, e.strokes == 1 ? "" : "s"));
  } else if (!std::isfinite(e.agreement)) {
    say("strokes_untied", "the strokes meet too seldom to be compared: fewer than two could be predicted from others");
  } else if (high < kLeastAgreement || !(e.agreement > 0.0)) {
    say("strokes_disagree", "the strokes do not agree: " + shared);
  } else if (!(low > 0.0)) {
    say("strokes_untied", "the strokes meet too seldom to be compared: " + shared);
  } else {
    if (e.agreement < kLeastAgreement) say("strokes_differ", shared);
    if (!std::isfinite(e.noise_m) || !std::isfinite(e.rms_m)) {
      say("area_noise_unknown", "the strokes state no noise: their agreement alone shows that the surface is above it");
    } else if (e.noise_m * e.noise_m * kLeastSnr > e.rms_m * e.rms_m) {
      say("area_below_noise",
          fmt::format("the surface's {:.3g} µm RMS are below the noise: a stroke has {:.3g} µm of it", 1e6 * e.rms_m,
                      1e6 * e.noise_m));
    }
    if (e.covered < kLeastCovered) {
      say("area_sparse",
          fmt::format("stripes only: {:.0f} % of the patch have heights, as these correlate over {:.2g} mm",
                      100.0 * e.covered, e.correlation_mm));
    }
    if (!std::isfinite(e.held_out_ratio)) {
      say("area_sigma_doubtful", "no stroke could be left out: the map's standard deviation was not tested");
    } else if (e.held_out_ratio < kRatioLow || e.held_out_ratio > kRatioHigh) {
      say("area_sigma_doubtful",
          fmt::format("strokes that were left out differ from the map by {:.2g} times its standard deviation",
                      e.held_out_ratio));
    }
  }
  if (e.stretch_max > 1.0 + kStretch || e.stretch_min < 1.0 - kStretch) {
    say("area_stretched",
        fmt::format("the patch is curved: lengths in its plane are {:.2f} to {:.2f} times those of the "
                    "surface",
                    e.stretch_min, e.stretch_max));
  }
  sort_verdicts(out);
  return out;
}

}  // namespace asperity
