#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/fidelity/score_realism.h"
#include "asperity/recording/fingerprint.h"
#include "asperity/render/render_model.h"
#include "asperity/scene/scene.h"
#include "asperity/texture/texture.h"

namespace asperity {

// A recording that a texture or scene was made from.
struct StrokeSource {
  std::string name;
  std::string checksum;     // recording_checksum() (register_input.h); empty: not known
  Fingerprint fingerprint;  // of its samples; empty: not known

  bool is_sketched() const { return fingerprint.probe.windows + fingerprint.poses.windows > 0; }
};

// Notes in a texture's extra.made_from of which recordings it was made, and reads them. A texture without that has the
// name that its source states, with no checksum.
void note_sources(Texture& texture, const std::vector<StrokeSource>& sources);
std::vector<StrokeSource> sources_of(const Texture& texture);

// The recordings behind what a texture is fitted to: a recording itself, what a texture file notes, or the texture.json
// in the folder where `process` or `merge` has written the file. None: not known.
std::vector<StrokeSource> sources_of_input(const std::filesystem::path& path, const Observer& observer = {});

// What is rendered: a texture, the profile of a result of process or merge, or a scene.
struct RenderedInput {
  std::optional<Scene> scene;
  Texture texture;               // of a profile: what else its texture.json has
  std::vector<double> height_m;  // of a profile: texture_m; empty: the texture's own heights
  double spacing_m = 0.0;        // of these
  std::vector<StrokeSource> sources;
};

// Reads a *.texture.json, a folder of process or merge (its whole profile, laid as `register` lays one), a scene.json
// or a folder that has one. Throws Error naming the file.
RenderedInput read_rendered(const std::filesystem::path& path, const Observer& observer = {});

// Whether a recording is among the sources: by its samples (is_same_measurement(), so that a part of it or a copy saved
// again counts), by its checksum, and by its name where no checksum is known.
bool is_among(const std::vector<StrokeSource>& sources, const StrokeSource& recording);

// A recording as a source, by the name given.
StrokeSource source_of(const std::filesystem::path& folder, const Recording& recording, const std::string& name);

// A recording processed for the comparison (score_realism.h): over the scene where there is one. Throws Error naming
// the folder that it is from.
RealStroke measure_real_stroke(const std::filesystem::path& folder, const Recording& recording,
                               const RenderedInput& rendered, const ProcessConfig& config,
                               const Observer& observer = {});

// The surface under a stroke.
RenderedRelief relief_under(const RenderedInput& rendered, const RealStroke& stroke, const RenderConfig& otherwise);

// result.json of a comparison, and some lines for a person.
Json realism_json(const RealismScore& score);
std::string realism_text(const RealismScore& score);

}  // namespace asperity
