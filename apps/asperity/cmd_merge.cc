#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/folder_content.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/merge_results.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/profile/merge_gain.h"
#include "asperity/session/merge_input.h"
#include "commands.h"

namespace asperity::app {

namespace {

std::string merge_summary(const ProcessResult& result, const MergeConfig& config) {
  const MergedProfile& merged = *result.passes;
  std::string out = fmt::format("  {} of {} strokes over one line\n", merged.used, merged.passes.size());
  for (const MergedPass& pass : merged.passes) {
    out += "  " + printable(pass.name, 200) + ": ";
    if (!pass.used) {
      out += fmt::format("left out, agreement {:.1f} of at least {:.1f}\n", pass.alignment.score,
                         pass.alignment.threshold);
      continue;
    }
    out +=
        fmt::format("{}, from {:.3f} mm, stretch {:+.2f} %, weight {:.2f}", pass.alignment.reversed ? "back" : "forth",
                    1e3 * pass.shift_m, 100.0 * pass.stretch, pass.weight);
    if (std::isfinite(pass.coherence)) out += fmt::format(", coherence {:.3f}", pass.coherence);
    out += "\n";
  }
  if (!merged.agrees) return out;
  if (std::isfinite(merged.noise_ratio)) {
    out +=
        fmt::format("  noise of a stroke by their differences: {:.2g} times the power stated, 95 %: {:.2g} to {:.2g}\n",
                    merged.noise_ratio, merged.noise_ratio_low, merged.noise_ratio_high);
  }
  const MergeGain gain = merge_gain(merged, config.align);
  if (std::isfinite(gain.share)) {
    out += fmt::format("  noise in the band: {:.2g} µm RMS of one stroke, {:.2g} µm of the merge, {:.2f} of it\n",
                       1e6 * gain.stroke_noise_rms_m, 1e6 * gain.merged_noise_rms_m, gain.share);
  }
  out += fmt::format("  merged: {:.2f} mm", 1e3 * result.coverage.length_m);
  if (std::isfinite(result.noise.noise_rms_m))
    out += fmt::format(", noise {:.2g} µm RMS, signal to noise {:.3g} (power)", 1e6 * result.noise.noise_rms_m,
                       result.noise.snr);
  if (result.roughness && std::isfinite(result.roughness->Rq_m))
    out += fmt::format(", Rq {:.1f} ± {:.1f} µm", 1e6 * result.roughness->Rq_m,
                       1e6 * result.roughness->standard_error.Rq_m);
  return out + "\n";
}

class MergeCommand : public Command {
 public:
  explicit MergeCommand(Parser& root)
      : Command(root, "merge",
                "Merge several strokes over one line to one profile, aligned and averaged by their noise") {
    require(parser().add_option("PASS", inputs_,
                                "Two or more recordings, or folders that process has written with "
                                "--set profile.remove_noise=false"));
    require(parser().add_option("-o,--output", output_, "Folder of the result"))->type_name("OUT");
  }

  std::vector<ConfigField> fields() override { return list_fields("", config_); }

  int run(const Observer& observer) override {
    if (inputs_.size() < 2) throw UsageError("PASS: a merge needs at least two strokes");
    OutputFolder folder(output_, naming_added(is_result_folder));
    MergeInput input;
    const std::vector<std::string> names = stroke_names(inputs_);
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      reads(inputs_[i]);
      add_stroke(input, inputs_[i], names[i], config_, observer);
    }
    reads("");
    const std::string object = input.title();
    ProcessResult result = merge_results(input.strokes, object, config_);
    if (result.texture) note_sources(*result.texture, input.sources);
    observer.update("writing", 1.0);
    if (result.passes->agrees) {
      write_merge(folder.path(), result, config_, object);
      commit_output(folder, output_);
    }
    print_json(merge_json(result, config_, object).dump_repaired(2));
    say(merge_summary(result, config_));
    if (result.passes->agrees) say("result in " + printable(output_, 200) + "\n");
    for (const Verdict& verdict : result.verdicts) {
      if (verdict.severity != Severity::kNote) print_error(verdict_line(verdict));
    }
    return result.trustworthy ? kDone : kNotTrustworthy;
  }

 private:
  std::vector<std::string> inputs_;
  std::string output_;
  MergeConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_merge(Parser& root) { return std::make_unique<MergeCommand>(root); }

}  // namespace asperity::app
