#pragma once

#include "asperity/base/progress.h"
#include "asperity/texture/autoregressive.h"
#include "asperity/texture/fit_autoregressive.h"
#include "asperity/texture/import_penn.h"
#include "asperity/texture/texture_model_traits.h"

namespace asperity {

// Its contact_force is the tool's vibration as a force of mean zero, no stronger than the load that carries it (Romano
// and Kuchenbecker 2012).
template <>
struct TextureModelTraits<AutoregressiveTexture> {
  static constexpr std::string_view kName = "autoregressive";
  static void read_block(const BlockInput& input, AutoregressiveTexture& t);
  static std::string write_block(const AutoregressiveTexture& t, BlockOutput& output);
  static Json describe(const AutoregressiveTexture& t);
  static void scale(AutoregressiveTexture& t, double factor);
  static void add_to(TextureHash& hash, const AutoregressiveTexture& t);

  static constexpr std::string_view kForceName = "autoregressive";
  static SeriesContactForce contact_force(const AutoregressiveTexture& t, SeriesState& state,
                                          const SeriesContact& contact) noexcept;
  static void stroke(const AutoregressiveTexture& t, const StrokeConfig& config, std::vector<double>& acceleration_mps2,
                     const Observer& observer);
  static void prepare(AutoregressiveTexture& t, double rate_Hz);

  struct FitOptions {
    FitAutoregressiveConfig autoregressive;
    ImportPennConfig penn;

    template <class V>
    void visit(V& v) {
      v.group("autoregressive", autoregressive);
      v.group("penn", penn);
    }
  };
  static void fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out);
};

}  // namespace asperity
