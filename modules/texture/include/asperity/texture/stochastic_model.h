#pragma once

#include "asperity/base/progress.h"
#include "asperity/texture/fit_stochastic.h"
#include "asperity/texture/stochastic.h"
#include "asperity/texture/texture_model_traits.h"

namespace asperity {

// Its contact_force is k Δh n − ρ k (H − offset) v̂, v̂ along the motion, H the next height, Δh = clamp(H − z, 0, H):
// heights above the mean brake and those below it yield (Siira and Pai 1996, whose ρ approximates Coulomb friction;
// erratum 27). k is the texture's stiffness, or, where that is negative, the place's.
template <>
struct TextureModelTraits<StochasticTexture> {
  static constexpr std::string_view kName = "stochastic";
  static void read_block(const BlockInput& input, StochasticTexture& t);
  static std::string write_block(const StochasticTexture& t, BlockOutput& output);
  static Json describe(const StochasticTexture& t);
  static void scale(StochasticTexture& t, double factor);
  static void add_to(TextureHash& hash, const StochasticTexture& t);
  static void low_pass(StochasticTexture& t, double cutoff_cycles_per_mm);

  static constexpr std::string_view kForceName = "stochastic";
  static SeriesContactForce contact_force(const StochasticTexture& t, SeriesState& state,
                                          const SeriesContact& contact) noexcept;
  static void stroke(const StochasticTexture& t, const StrokeConfig& config, std::vector<double>& acceleration_mps2,
                     const Observer& observer);
  static void prepare(StochasticTexture& t, double rate_Hz);
  static SeriesHeights heights(const StochasticTexture& t);
  // σ and the correlation length of the heights along x, several lines of them (thesis §6.5: "variance equal to the
  // variation in height of the texture function").
  static void take_heights(StochasticTexture& t, const Texture& height_field);

  struct FitOptions {
    FitStochasticConfig stochastic;

    template <class V>
    void visit(V& v) {
      v.group("stochastic", stochastic);
    }
  };
  static void fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out);
};

}  // namespace asperity
