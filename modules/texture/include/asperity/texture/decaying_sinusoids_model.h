#pragma once

#include "asperity/base/progress.h"
#include "asperity/texture/decaying_sinusoids.h"
#include "asperity/texture/fit_decaying_sinusoids.h"
#include "asperity/texture/texture_model_traits.h"

namespace asperity {

// Its contact_force is the tool's ringing; a new contact begins a tap with the speed of approach (Okamura, Dennerlein
// and Howe 1998).
template <>
struct TextureModelTraits<DecayingSinusoids> {
  static constexpr std::string_view kName = "decaying_sinusoids";
  static void read_block(const BlockInput& input, DecayingSinusoids& t);
  static std::string write_block(const DecayingSinusoids& t, BlockOutput& output);
  static Json describe(const DecayingSinusoids& t);
  static void scale(DecayingSinusoids& t, double factor);
  static void add_to(TextureHash& hash, const DecayingSinusoids& t);

  static constexpr std::string_view kForceName = "decaying-sinusoids";
  static SeriesContactForce contact_force(const DecayingSinusoids& t, SeriesState& state,
                                          const SeriesContact& contact) noexcept;
  static void start_contact(const DecayingSinusoids& t, SeriesState& state, const SeriesContact& contact) noexcept;
  static void stroke(const DecayingSinusoids& t, const StrokeConfig& config, std::vector<double>& acceleration_mps2,
                     const Observer& observer);

  struct FitOptions {
    FitDecayingSinusoidsConfig decaying_sinusoids;

    template <class V>
    void visit(V& v) {
      v.group("decaying_sinusoids", decaying_sinusoids);
    }
  };
  static void fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out);
};

}  // namespace asperity
