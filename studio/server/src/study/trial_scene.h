#pragma once

#include <string>
#include <vector>

#include "asperity/scene/scene.h"
#include "asperity/studio/block.h"
#include "asperity/study/study.h"
#include "asperity/study/trial.h"
#include "feel/feel_setup.h"

namespace asperity::studio {

// Device and settings of a study, upon those of the start. Throws Error for a device that there is none of.
FeelSetup study_setup(const Study& study, const FeelConfig& start);

// What is rendered in a trial, of the textures in the order of the stimuli: its tiles side by side on a plane, called A
// and B.
Scene make_trial_scene(const Study& study, const std::vector<Texture>& stimuli, const Trial& trial);

// For each triangle of a trial's scene: the tile that it belongs to, 0 (left) or 1 (right), or -1.
std::vector<int> tile_of_triangle(const Study& study);

// What the browser draws of any trial of a study, and all that it receives: the tiles, without heights.
BlockWriter make_trial_block(const Study& study);

// The texture with heights (or, of a series, forces) times `factor`.
void scale_texture(Texture& texture, double factor);

}  // namespace asperity::studio
