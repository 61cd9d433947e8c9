#pragma once

#include <optional>

#include "asperity/texture/height_and_gradient.h"
#include "asperity/texture/texture.h"

namespace asperity {

// True for the models that are heights over a plane; the others are forces in time.
bool is_height_field(const TextureModel& model) noexcept;

// A height field and its gradient, x_m along the scan path and y_m across it; a model of x alone is the same
// for every y. Without the texture's lift. nan for a model that is no height field. Does not allocate.
// Realtime-safe: yes, thread-safe: yes.
HeightAndGradient evaluate_height(const TextureModel& model, double x_m, double y_m) noexcept;

// The lowest point of a height field, and what must be added for it to lie on the geometric surface (erratum
// 20). Throws Error for a model that is no height field.
double lowest_height_m(const TextureModel& model);
double lift_m(const TextureModel& model);

// The length along x, in metres, after which the model repeats; nullopt for one that does not.
std::optional<double> period_m(const TextureModel& model);

}  // namespace asperity
