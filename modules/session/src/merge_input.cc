#include "asperity/session/merge_input.h"

#include <set>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/session/register_input.h"
#include "asperity/texture/texture_file.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// The last part of a path, that of "rec/" included.
std::string last_part(const std::string& path) {
  fs::path whole = fs::absolute(path).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  return whole.filename().string();
}

// Of what a result was made, by its texture; its name where it has none.
void add_sources_of_result(MergeInput& input, const fs::path& folder, const std::string& name,
                           const Observer& observer) {
  std::vector<StrokeSource> sources;
  if (fs::exists(folder / "texture.json")) sources = sources_of(read_texture(folder / "texture.json", {}, observer));
  if (sources.empty()) sources.push_back({name, "", {}});
  input.sources.insert(input.sources.end(), sources.begin(), sources.end());
}

}  // namespace

std::vector<std::string> stroke_names(const std::vector<std::string>& paths) {
  std::vector<std::string> out;
  std::set<std::string> taken;
  for (const std::string& path : paths) {
    std::string name = last_part(path);
    if (name.empty()) throw Error(printable(path, 200) + ": has no name");
    // Strokes of several sessions may be called the same.
    if (!taken.insert(name).second) name = path;
    taken.insert(name);
    out.push_back(std::move(name));
  }
  return out;
}

bool is_processed(const fs::path& folder) { return fs::is_regular_file(folder / "result.json"); }

ProcessConfig stroke_config(const MergeConfig& config) {
  ProcessConfig out = config.process;
  out.profile.remove_noise = false;
  out.profile.merge_passes = false;
  return out;
}

void add_recorded_stroke(MergeInput& input, const fs::path& folder, const std::string& name, const Recording& recording,
                         const ProcessResult& result) {
  if (result.profile.size() == 0) throw Error(printable(folder.string(), 200) + ": " + result.verdict);
  if (input.object.empty()) input.object = recording.info.object;
  input.strokes.push_back(stroke_of_result(result, recording, name));
  input.sources.push_back(source_of(folder, recording, name));
}

void add_stroke(MergeInput& input, const fs::path& folder, const std::string& name, const MergeConfig& config,
                const Observer& observer) {
  if (is_processed(folder)) {
    add_sources_of_result(input, folder, name, observer);
    input.strokes.push_back(read_stroke(folder, name));
    return;
  }
  const Recording recording = read_recording(folder, {}, observer);
  ProcessResult result;
  try {
    result = process_recording(recording, stroke_config(config), observer);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    throw Error(printable(folder.string(), 200) + ": " + error.what());
  }
  add_recorded_stroke(input, folder, name, recording, result);
}

}  // namespace asperity
