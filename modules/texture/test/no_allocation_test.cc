// The servo's evaluators do not touch the heap: every operator new of this program is counted.
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/random.h"
#include "asperity/testkit/count_allocations.h"
#include "asperity/texture/autoregressive_filter.h"
#include "asperity/texture/evaluate_autoregressive.h"
#include "asperity/texture/evaluate_decaying_sinusoids.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/evaluate_stochastic.h"
#include "asperity/texture/synthesize_isotropic.h"

namespace asperity {
namespace {

template <class Texture>
std::size_t allocations_of(const Texture& texture) {
  static_assert(noexcept(next_force(texture, std::declval<SeriesState&>(), 0.0, 0.0, 0.0)));
  SeriesState state = start_series(1);
  Random random(2);
  const std::size_t before = testkit::count_allocations();
  double sum = 0.0;
  for (int i = 0; i < 2000; ++i)
    sum += next_force(texture, state, random.uniform(-0.1, 0.5), random.uniform(-1.0, 5.0), 1e-3).normal_N;
  EXPECT_TRUE(sum == sum);
  return testkit::count_allocations() - before;
}

TEST(NoAllocation, OfSeriesTextures) {
  const std::size_t before = testkit::count_allocations();
  ::operator delete(::operator new(1));
  ASSERT_GT(testkit::count_allocations(), before) << "the counter counts";

  EXPECT_EQ(allocations_of(StochasticTexture{.sigma_m = 1e-5, .correlation_length_m = 1e-4, .speed_exponent = 0.5}),
            0u);
  EXPECT_EQ(allocations_of(DecayingSinusoids{.a_per_s = 10.0, .pitch_m = 1e-3}), 0u);
  Random random(3);
  AutoregressiveTexture t;
  for (int i = 0; i < 40; ++i) {
    std::vector<double> k(20), b(8);
    for (double& v : k) v = random.uniform(-0.7, 0.7);
    for (double& v : b) v = random.uniform(-0.5, 0.5);
    t.models.push_back(
        {random.uniform(0.0, 0.3), random.uniform(0.0, 3.0), reflection_to_lsf(k), reflection_to_lsf(b), 1.0, 1.0});
  }
  prepare_autoregressive(t, "test");
  EXPECT_EQ(allocations_of(t), 0u);
}

TEST(NoAllocation, HeightFieldsDoNotEither) {
  static_assert(noexcept(evaluate_height(std::declval<const TextureModel&>(), 0.0, 0.0)));
  const Fourier1d series{10.0, std::vector<double>(128, 1e-6), std::vector<double>(128, 1e-6), 0.0};
  Fourier2d product;
  product.x = product.y = series;
  Fourier2d isotropic;
  isotropic.kind = Fourier2dKind::kIsotropic;
  isotropic.isotropic.power_m2 = {1e-12, 1e-12};
  isotropic.grid = synthesize_isotropic(isotropic.isotropic);
  const HeightMap map{4, 4, 0.1, 0.1, 0.0, 1e-5, 16, Border::kMirror, std::vector<std::uint16_t>(16, 7)};
  for (const TextureModel& model : {TextureModel(series), TextureModel(product), TextureModel(isotropic),
                                    TextureModel(map), TextureModel(ArealTexture{isotropic.grid, {}})}) {
    Random random(2);
    const std::size_t before = testkit::count_allocations();
    double sum = 0.0;
    for (int i = 0; i < 500; ++i)
      sum += evaluate_height(model, random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)).height_m;
    EXPECT_EQ(testkit::count_allocations(), before) << model.index();
    EXPECT_TRUE(sum == sum);
  }
}

}  // namespace
}  // namespace asperity
