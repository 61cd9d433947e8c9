#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/merge_results.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/recording/read_recording.h"
#include "asperity/session/register_input.h"
#include "asperity/session/rendered_input.h"
#include "asperity/texture/texture_file.h"
#include "commands.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

// The last part of a path, that of "rec/" included.
std::string last_part(const std::string& path) {
  fs::path whole = fs::absolute(path).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  return whole.filename().string();
}

std::string merge_summary(const ProcessResult& result) {
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
      : Command(root, "merge", "Several strokes over one line as one profile, aligned and averaged by their noise") {
    require(parser().add_option("PASS", inputs_,
                                "Two or more recordings, or folders that process has written with "
                                "--set profile.remove_noise=false"));
    require(parser().add_option("-o,--output", output_, "Folder of the result"))->type_name("OUT");
  }

  std::vector<ConfigField> fields() override { return list_fields("", config_); }

  int run(const Observer& observer) override {
    if (inputs_.size() < 2) throw UsageError("PASS: a merge needs at least two strokes");
    OutputFolder folder(output_, is_result_folder);
    std::vector<MergeStroke> strokes;
    std::string object;
    std::set<std::string> names;
    for (const std::string& input : inputs_) {
      std::string name = last_part(input);
      if (name.empty()) throw UsageError("PASS: a folder has no name");
      // Strokes of several sessions may be called the same.
      if (!names.insert(name).second) name = input;
      names.insert(name);
      reads(input);
      strokes.push_back(read(input, name, observer, object));
    }
    reads("");
    if (object.empty()) object = "merged";
    ProcessResult result = merge_results(strokes, object, config_);
    if (result.texture) note_sources(*result.texture, sources_);
    observer.update("writing", 1.0);
    if (result.passes->agrees) {
      write_merge(folder.path(), result, config_, object);
      commit_output(folder, output_);
    }
    print_json(merge_json(result, config_, object).dump_repaired(2));
    say(merge_summary(result));
    if (result.passes->agrees) say("result in " + printable(output_, 200) + "\n");
    for (const Verdict& verdict : result.verdicts) {
      if (verdict.severity != Severity::kNote) print_error(verdict_line(verdict));
    }
    return result.trustworthy ? kDone : kNotTrustworthy;
  }

 private:
  MergeStroke read(const std::string& input, const std::string& name, const Observer& observer, std::string& object) {
    if (fs::is_regular_file(fs::path(input) / "result.json")) {
      add_sources_of_result(input, name, observer);
      return read_stroke(input, name);
    }
    sources_.push_back({name, recording_checksum(input)});
    const Recording recording = read_recording(input, {}, observer);
    if (object.empty()) object = recording.info.object;
    ProcessConfig config = config_.process;
    config.profile.remove_noise = false;
    config.profile.merge_passes = false;
    ProcessResult result;
    try {
      result = process_recording(recording, config, observer);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      throw Error(printable(input, 200) + ": " + error.what());
    }
    if (result.profile.size() == 0) throw Error(printable(input, 200) + ": " + result.verdict);
    return stroke_of_result(result, recording, name);
  }

  // Of what a result was made, by its texture; its name where it has none.
  void add_sources_of_result(const fs::path& folder, const std::string& name, const Observer& observer) {
    std::vector<StrokeSource> sources;
    if (fs::exists(folder / "texture.json")) sources = sources_of(read_texture(folder / "texture.json", {}, observer));
    if (sources.empty()) sources.push_back({name, ""});
    sources_.insert(sources_.end(), sources.begin(), sources.end());
  }

  std::vector<std::string> inputs_;
  std::string output_;
  std::vector<StrokeSource> sources_;
  MergeConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_merge(Parser& root) { return std::make_unique<MergeCommand>(root); }

}  // namespace asperity::app
