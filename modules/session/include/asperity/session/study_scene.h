#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "asperity/scene/scene.h"
#include "asperity/session/feel_settings.h"
#include "asperity/study/study.h"
#include "asperity/study/trial.h"

namespace asperity {

// What is rendered in a trial, of the textures in the order of the stimuli: its tiles side by side on a plane, called A
// and B.
Scene make_trial_scene(const Study& study, const std::vector<Texture>& stimuli, const Trial& trial);

// The tiles without textures: all trials of a study have this mesh.
Scene make_blank_trial_scene(const Study& study);

// For each triangle of a trial's scene: the tile that it belongs to, 0 (left) or 1 (right), or -1.
std::vector<int> tile_of_triangle(const Study& study);

// How many tiles a trial has: 1 to be rated, 2 to be compared.
std::size_t tiles_of(const Study& study);

// From the left of the tiles to their right, m: what a modelled hand strokes.
std::array<Eigen::Vector3d, 2> trial_stroke_m(const Study& study);

// How the study presents textures: stiffness, friction and the model of the texture's force.
void apply_presentation(const Study& study, FeelSettings& settings);

// The texture with heights (or, of a series, forces) times `factor`.
void scale_texture(Texture& texture, double factor);

}  // namespace asperity
