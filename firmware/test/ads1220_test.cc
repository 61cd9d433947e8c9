#include "asperity_firmware/ads1220.h"

#include <gmock/gmock.h>
#include <functional>

#include "asperity_firmware/ads1220_model.h"

namespace asperity {
namespace {

// The register model, with DRDY.
class SimulatedAds1220 {
 public:
  SimulatedAds1220() {
    asp_ads1220_model_init(&model_);
    model_.context = this;
    model_.during_read = [](void* self) {
      const auto& happen = static_cast<SimulatedAds1220*>(self)->during_read;
      if (happen) happen();
    };
    spi_ = {&model_,
            [](void* model, const std::uint8_t* out, std::uint8_t* in, std::size_t count) {
              return asp_ads1220_model_transfer(static_cast<asp_ads1220_model*>(model), out, in, count);
            },
            [](void*, std::uint32_t) {}};
  }
  SimulatedAds1220(const SimulatedAds1220&) = delete;
  SimulatedAds1220& operator=(const SimulatedAds1220&) = delete;
  const asp_spi* spi() const { return &spi_; }

  void finish_conversion(std::int32_t counts, std::uint64_t now_us, asp_ads1220* device) {
    if (asp_ads1220_model_finish(&model_, counts)) asp_edge_fire(&device->edge, now_us);
  }

 private:
  asp_ads1220_model model_{};
  asp_spi spi_{};

 public:
  std::uint8_t (&registers)[4] = model_.registers;
  bool& converting = model_.converting;
  bool& present = model_.present;
  bool& bus_works = model_.bus_works;
  std::function<void()> during_read;
};

TEST(Ads1220, IsConfiguredAsTheDatasheetSays) {
  for (const auto& [rate, code, sps] : {std::tuple{ASP_ADS1220_350_SPS, 3, 350u},
                                        {ASP_ADS1220_660_SPS, 4, 660u},
                                        {ASP_ADS1220_1200_SPS, 5, 1200u},
                                        {ASP_ADS1220_2000_SPS, 6, 2000u}}) {
    SimulatedAds1220 converter;
    asp_ads1220 device;
    ASSERT_EQ(asp_ads1220_start(&device, converter.spi(), rate), ASP_ADS1220_OK);
    EXPECT_EQ(asp_ads1220_rate_sps(rate), sps);
    EXPECT_EQ(converter.registers[0] >> 4, 0);        // AIN0 against AIN1
    EXPECT_EQ((converter.registers[0] >> 1) & 7, 7);  // gain 128
    EXPECT_EQ(converter.registers[0] & 1, 0);         // amplifier on
    EXPECT_EQ(converter.registers[1] >> 5, code);
    EXPECT_EQ((converter.registers[1] >> 3) & 3, 2);  // turbo
    EXPECT_EQ(converter.registers[1] & 7, 4);         // continuous, no temperature, no burn-out currents
    EXPECT_EQ(converter.registers[2], 0xC0);          // reference AVDD
    EXPECT_EQ(converter.registers[3], 0);
    EXPECT_TRUE(converter.converting);
  }
}

TEST(Ads1220, SaysWhyItDoesNotStart) {
  SimulatedAds1220 converter;
  asp_ads1220 device;
  converter.present = false;
  EXPECT_EQ(asp_ads1220_start(&device, converter.spi(), ASP_ADS1220_660_SPS), ASP_ADS1220_NOT_AS_WRITTEN);
  converter.bus_works = false;
  EXPECT_EQ(asp_ads1220_start(&device, converter.spi(), ASP_ADS1220_660_SPS), ASP_ADS1220_BUS_FAILED);
}

TEST(Ads1220, ExtendsTheSign) {
  const auto counts = [](std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    const std::uint8_t bytes[3] = {a, b, c};
    return asp_ads1220_counts(bytes);
  };
  EXPECT_EQ(counts(0, 0, 0), 0);
  EXPECT_EQ(counts(0, 0, 1), 1);
  EXPECT_EQ(counts(0x7F, 0xFF, 0xFF), 8388607);
  EXPECT_EQ(counts(0x80, 0, 0), -8388608);
  EXPECT_EQ(counts(0xFF, 0xFF, 0xFF), -1);
  EXPECT_EQ(counts(0xFF, 0xFE, 0xFF), -257);
}

TEST(Ads1220, GivesEachConversionOnceAtItsMiddle) {
  SimulatedAds1220 converter;
  asp_ads1220 device;
  ASSERT_EQ(asp_ads1220_start(&device, converter.spi(), ASP_ADS1220_2000_SPS), ASP_ADS1220_OK);
  asp_force_sample sample;
  EXPECT_FALSE(asp_ads1220_read(&device, &sample));
  for (std::int32_t i = 0; i < 1000; ++i) {
    const std::int32_t truth = (i * 7919 * 31) % 8388608 * (i % 2 == 0 ? 1 : -1);
    const std::uint64_t now_us = 10000 + 500u * static_cast<unsigned>(i);
    converter.finish_conversion(truth, now_us, &device);
    ASSERT_TRUE(asp_ads1220_read(&device, &sample));
    EXPECT_EQ(sample.counts[0], truth);
    EXPECT_EQ(sample.time_us, now_us - 250);
    EXPECT_FALSE(asp_ads1220_read(&device, &sample));
  }
}

TEST(Ads1220, DoesNotGiveAValueOfWhichTheTimeIsNotKnown) {
  SimulatedAds1220 converter;
  asp_ads1220 device;
  ASSERT_EQ(asp_ads1220_start(&device, converter.spi(), ASP_ADS1220_2000_SPS), ASP_ADS1220_OK);
  asp_force_sample sample;
  converter.finish_conversion(1, 1000, &device);
  converter.during_read = [&] { converter.finish_conversion(2, 1500, &device); };
  EXPECT_FALSE(asp_ads1220_read(&device, &sample));
  converter.during_read = nullptr;
  ASSERT_TRUE(asp_ads1220_read(&device, &sample));
  EXPECT_EQ(sample.counts[0], 2);
  EXPECT_EQ(sample.time_us, 1250u);
  EXPECT_EQ(device.skipped, 1u);
}

TEST(Ads1220, CountsConversionsThatTheLoopCameTooLateFor) {
  SimulatedAds1220 converter;
  asp_ads1220 device;
  ASSERT_EQ(asp_ads1220_start(&device, converter.spi(), ASP_ADS1220_2000_SPS), ASP_ADS1220_OK);
  asp_force_sample sample;
  converter.finish_conversion(1, 1000, &device);
  converter.finish_conversion(2, 1500, &device);
  converter.finish_conversion(3, 2000, &device);
  ASSERT_TRUE(asp_ads1220_read(&device, &sample));
  EXPECT_EQ(sample.counts[0], 3);
  EXPECT_EQ(sample.time_us, 1750u);  // of the value that was read, not of the first that was announced
  EXPECT_EQ(device.skipped, 2u);
  EXPECT_FALSE(asp_ads1220_read(&device, &sample));
}

TEST(Ads1220, GoesOnAfterTheBusFailed) {
  SimulatedAds1220 converter;
  asp_ads1220 device;
  ASSERT_EQ(asp_ads1220_start(&device, converter.spi(), ASP_ADS1220_350_SPS), ASP_ADS1220_OK);
  asp_force_sample sample;
  converter.finish_conversion(1, 10000, &device);
  converter.bus_works = false;
  EXPECT_FALSE(asp_ads1220_read(&device, &sample));
  converter.bus_works = true;
  converter.finish_conversion(2, 20000, &device);
  EXPECT_TRUE(asp_ads1220_read(&device, &sample));
  EXPECT_EQ(sample.counts[0], 2);
  EXPECT_EQ(device.bus_failures, 1u);
}

}  // namespace
}  // namespace asperity
