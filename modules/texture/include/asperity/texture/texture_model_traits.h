#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "asperity/texture/height_and_gradient.h"
#include "asperity/texture/series_state.h"
#include "asperity/texture/servo_tables.h"

namespace asperity {

struct BlockInput;
struct BlockOutput;
struct FittedTexture;
struct StrokeConfig;
struct Texture;
struct TextureFitInput;
struct TextureFitOptions;
class Json;
class TextureHash;

// All that the program knows of a texture model beside its data. A model is a struct of plain data and its
// specialisation of TextureModelTraits, declared in <model>_model.h and named once, in texture_models.h; files, command
// line, renderer and studies visit that list. Its static members, those in brackets only where the model has them:
//
//   every model
//     kName                                  in files (key `model`), of `texture fit --model` and in `texture info`
//     read_block(input, model)               from its block of a *.texture.json; throws Error naming file, line, key
//     write_block(model, output)             its block's text; throws Error for what could not be read again
//     describe(model)                        for `texture info`
//     scale(model, factor)                   heights or forces `factor` times as large (the stimuli of a study)
//     add_to(hash, model)                    all that its force depends on
//     [low_pass(model, cutoff_cycles_per_mm)]     see low_pass_texture()
//     [reseed(model, seed)]                  false if this one has no random numbers
//     [size_bytes(model)]                    of what it keeps outside of itself, about
//     [FitOptions, fit(input, options, out)] settings by group, and `texture fit`: see texture_fit.h
//
//   a height field, a height over a plane
//     height(model, x_m, y_m) noexcept       with its gradient; realtime-safe
//     lowest_m(model), highest_m(model)
//     periods_m(model)                       see HeightPeriods
//     window(model, most_cells)              see HeightWindow
//     highest_cycles_per_mm(model)           that it can represent
//     [length_mm(model)]                     its period, of a model of x alone: the same for every y
//     [measured_area(model)]                 see MeasuredArea; everything by default
//     [kIsSynthetic]                         true: its places are not those of the surface that it was made from
//     [make_tables(model, tables)]           for the servo, and
//     [servo_height(model, tables, x_m, y_m) noexcept]     height() by means of them; realtime-safe
//
//   a series, a force in time
//     kForceName                             of its force model on the command line
//     contact_force(model, state, contact) noexcept        one servo step; realtime-safe
//     stroke(model, config, acceleration_mps2, observer)   see synthesize_stroke()
//     [prepare(model, rate_Hz)]              for a servo of this rate
//     [start_contact(model, state, contact) noexcept]      on the first step of a contact, instead of contact_force
//     [heights(model)]                       see SeriesHeights; none by default
//     [take_heights(model, height_field)]    makes it of a height field, which it can then render
template <class Model>
struct TextureModelTraits;

// After how much of x and of y heights are the same again; infinite: never, 0: they are the same everywhere.
struct HeightPeriods {
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  double x_m = kNever;
  double y_m = kNever;
};

// The part of its plane in which a height field shows all that it has: a period, or an image or a grid that does not
// repeat.
struct HeightWindow {
  double x_m = 0.0;
  double y_m = 0.0;
  double length_m = 0.01;
  double width_m = 0.01;
  std::size_t columns = 128;  // cells: of its grid, or four to the shortest wave
  std::size_t rows = 128;
};

// Where the lines lie along which a height field's roughness is measured: from (x_m, y_m) on, over this width.
struct MeasuredArea {
  double x_m = 0.0;
  double y_m = 0.0;
  double width_m = 0.0;
};

// How a series is touched at one servo step. Plain data.
struct SeriesContact {
  double speed_mps = 0.0;          // of the tip over the surface
  double load_N = 0.0;             // of the geometric contact, not negative
  double approach_mps = 0.0;       // speed into the surface
  double z_m = 0.0;                // the tip's height above the geometric surface; negative inside
  double stiffness_N_per_m = 0.0;  // of the place
  double compliance_kc = 1.0;      // of the place
  double fade = 1.0;               // towards the border of a textured area, 1 well inside (erratum 20)
  double dt_s = 1e-3;
};

// The tangential part is friction's (erratum 19): where it is positive it is against the motion.
struct SeriesContactForce {
  double normal_N = 0.0;
  double tangential_N = 0.0;
  double height_m = 0.0;  // of a series that has heights
  double depth_m = 0.0;   // how far they are pressed in
};

// By how much a series of heights is offset from the geometric surface, what none of its heights exceeds, and the
// stiffness that makes them forces; negative: that of the place.
struct SeriesHeights {
  double offset_m = 0.0;
  double highest_m = 0.0;
  double stiffness_N_per_m = -1.0;
};

template <class Model>
concept HeightField = requires(const Model& model) {
  TextureModelTraits<Model>::height(model, 0.0, 0.0);
};
template <class Model>
concept SeriesModel = requires {
  TextureModelTraits<Model>::kForceName;
};
// A height field that is the same for every y.
template <class Model>
concept LineModel = HeightField<Model> && requires(const Model& model) {
  TextureModelTraits<Model>::length_mm(model);
};
template <class Model>
concept FittedModel = requires {
  typename TextureModelTraits<Model>::FitOptions;
};

}  // namespace asperity
