#include "process/merge_strokes.h"

#include <limits>

#include "asperity/base/error.h"
#include "asperity/base/folder_content.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/profile/merge_gain.h"
#include "asperity/session/merge_input.h"
#include "asperity/studio/calls.h"
#include "asperity/studio/measured_block.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

// Processes it in its session, which keeps what does not depend on the merge's settings. A recording with segments is a
// stroke as a whole, as the command line has it.
void add_open(MergeInput& input, const NamedStroke& stroke, const MergeConfig& config, ScanSessions& sessions,
              const Observer& observer) {
  if (is_processed(stroke.folder)) return add_stroke(input, stroke.folder, stroke.name, config, observer);
  OpenScan& open = sessions.open(stroke.folder, "", observer);
  if (!open.segments.empty()) return add_stroke(input, stroke.folder, stroke.name, config, observer);
  try {
    const ProcessResult& result = open.session.process(stroke_config(config), observer);
    add_recorded_stroke(input, stroke.folder, stroke.name, open.session.recording(), result);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    const std::string folder = printable(stroke.folder.string(), 200), message = error.what();
    throw Error(message.find(folder) == std::string::npos ? folder + ": " + message : message);
  }
}

}  // namespace

MergedStrokes merge_strokes(const std::vector<NamedStroke>& strokes, const MergeConfig& config, ScanSessions& sessions,
                            const Observer& observer) {
  if (strokes.size() < 2)
    throw Advice("a merge needs at least two strokes", "Choose recordings of several strokes over one line.");
  MergeInput input;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    observer.update("stroke " + std::to_string(i + 1) + " of " + std::to_string(strokes.size()),
                    static_cast<double>(i) / static_cast<double>(strokes.size() + 1));
    add_open(input, strokes[i], config, sessions, observer.without_progress());
  }
  observer.update("merging", static_cast<double>(strokes.size()) / static_cast<double>(strokes.size() + 1));
  MergedStrokes out;
  out.config = config;
  out.object = input.title();
  out.result = merge_results(input.strokes, out.object, config);
  if (out.result.texture) note_sources(*out.result.texture, input.sources);
  observer.update("merged", 1.0);
  return out;
}

BlockWriter merge_block(const MergedStrokes& merged) {
  Recording recording;
  recording.info.object = merged.object;
  MeasuredBlockConfig whole;
  whole.max_profile_points = std::numeric_limits<std::size_t>::max();
  BlockWriter block = measured_block(merged.result, recording, merged.object, whole);
  block.head()["result"] = merge_json(merged.result, merged.config, merged.object);
  const MergedProfile& passes = merged.result.passes.value();
  const MergeGain gain = merge_gain(passes, merged.config.align);
  block.head()["gain"] = {{"stroke_noise_rms_m", number_or_null(gain.stroke_noise_rms_m)},
                          {"merged_noise_rms_m", number_or_null(gain.merged_noise_rms_m)},
                          {"share", number_or_null(gain.share)}};
  const std::size_t points = merged.result.profile.size();
  std::vector<float> texture_m;
  for (const MergedPass& pass : passes.passes) {
    for (std::size_t i = 0; i < points; ++i) {
      texture_m.push_back(i < pass.texture_m.size() ? static_cast<float>(pass.texture_m[i])
                                                    : std::numeric_limits<float>::quiet_NaN());
    }
  }
  block.add("stroke_texture_m", texture_m, {passes.passes.size(), points});
  return block;
}

Json write_merged(const fs::path& target, const MergedStrokes& merged) {
  if (!merged.result.passes->agrees)
    throw Advice(merged.result.verdict, "Choose strokes over one line; nothing was written.");
  OutputFolder folder(target, naming_added(is_result_folder));
  write_merge(folder.path(), merged.result, merged.config, merged.object);
  Json notes = Json::array();
  for (const Verdict& verdict : merged.result.verdicts) {
    if (verdict.severity != Severity::kNote) notes.push_back(verdict_line(verdict));
  }
  for (const fs::path& kept : folder.commit())
    notes.push_back(printable(kept.string(), 200) + " was added there in the meantime; it was kept");
  return {{"notes", std::move(notes)}};
}

}  // namespace asperity::studio
