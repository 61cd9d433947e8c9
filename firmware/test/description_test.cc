#include "asperity_firmware/description.h"

#include <gmock/gmock.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "asperity/base/random.h"

namespace asperity {
namespace {

using nlohmann::json;

asp_description bench_probe() {
  return {"bench probe 3", "1.0.0", 4000, -32768, 32767, 208.848, true, 939.65, 1, 330, 1.2e-06};
}

std::string written(const asp_description& description, std::size_t capacity = ASP_DESCRIPTION_MAX) {
  std::string out(capacity, '#');
  out.resize(asp_write_description(&description, reinterpret_cast<std::uint8_t*>(out.data()), out.size()));
  return out;
}

TEST(FirmwareDescription, IsTheDocumentsExample) {
  const json read = json::parse(written(bench_probe()));
  const json expected = json::parse(
      R"({"model":"open","name":"bench probe 3","firmware":"1.0.0","rate_hz":4000,"adc_min":-32768,"adc_max":32767,
"accel_counts_per_mps2":208.848,"gyro_counts_per_radps":939.65,"force_axes":1,"force_rate_hz":330,"force_newton_per_count":1.2e-06})");
  EXPECT_EQ(read, expected);
}

TEST(FirmwareDescription, LeavesTheGyroscopeOutWhereThereIsNone) {
  asp_description description = bench_probe();
  description.has_gyro = false;
  EXPECT_FALSE(json::parse(written(description)).contains("gyro_counts_per_radps"));
}

TEST(FirmwareDescription, EscapesTexts) {
  for (const std::string& name :
       {std::string("a\"b\\c\x01\x1F\x7F\n\t"), std::string("Größe ½ 探针 🖐"), std::string()}) {
    asp_description description = bench_probe();
    description.name = name.c_str();
    const std::string text = written(description);
    EXPECT_EQ(json::parse(text)["name"], name);
    for (const char c : text) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
  }
}

TEST(FirmwareDescription, RefusesTextsThatAreTooLongOrNotUtf8) {
  asp_description description = bench_probe();
  const std::string longest(64, 'x');
  description.name = longest.c_str();
  description.firmware = longest.c_str();
  EXPECT_EQ(json::parse(written(description))["firmware"], longest);
  for (const std::string& bad :
       {std::string(65, 'x'), std::string(63, 'x') + "½", std::string("\xC0\x80"), std::string("\xED\xA0\x80"),
        std::string("\xF5\x80\x80\x80"), std::string("\xE2\x82"), std::string("\x80"), std::string("\xF0\x8F\xBF\xBF"),
        std::string("\xF4\x90\x80\x80")}) {
    description.name = bad.c_str();
    EXPECT_EQ(written(description), "") << bad.size();
  }
}

TEST(FirmwareDescription, IsBoundedWhateverTheTexts) {
  asp_description description = bench_probe();
  const std::string worst(64, '\x01');
  description.name = worst.c_str();
  EXPECT_LE(written(description).size(), 1024u);
  EXPECT_EQ(json::parse(written(description))["name"], worst);
  description.firmware = worst.c_str();
  description.accel_counts_per_mps2 = 123456.789;
  description.gyro_counts_per_radps = 123456.789;
  description.force_newton_per_count = 1.23456789e-7;
  const std::string text = written(description, 4096);
  EXPECT_LE(text.size(), 1024u);
  if (!text.empty()) {
    EXPECT_EQ(json::parse(text)["firmware"], worst);
  }
}

TEST(FirmwareDescription, WritesFiguresToNineDigits) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    asp_description description = bench_probe();
    const double value = std::pow(10.0, -30.0 + 42.0 * random.uniform());
    description.force_newton_per_count = value;
    const double read = json::parse(written(description))["force_newton_per_count"];
    ASSERT_NEAR(read / value, 1.0, 5.1e-9) << value;  // half a unit of the ninth digit
  }
  for (const double value : {0.0, 1.0, 10.0, 4000.0, 1e5, 0.1, 8999.0, 99999.9999}) {
    asp_description description = bench_probe();
    description.rate_hz = value;
    EXPECT_EQ(json::parse(written(description))["rate_hz"].get<double>(), value);
  }
}

// printf rounds correctly; ours may differ by one in the ninth digit where the tenth is half a digit to 1e-15.
TEST(FirmwareDescription, WritesFiguresAsPrintfDoes) {
  Random random(11);
  int different = 0;
  for (int i = 0; i < 20000; ++i) {
    const double value = std::pow(10.0, random.uniform() * 24.0 - 12.0) * (1.0 + random.uniform());
    if (value > 1e12) continue;
    asp_description description = bench_probe();
    description.force_newton_per_count = value;
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.8e", value);
    const double got = json::parse(written(description))["force_newton_per_count"].get<double>();
    different += got == std::strtod(digits, nullptr) ? 0 : 1;
    ASSERT_NEAR(got / value, 1.0, 5.1e-9) << value;
  }
  EXPECT_LE(different, 1);
}

TEST(FirmwareDescription, WritesTheSmallestFigures) {
  for (const double value : {5e-324, 2.2250738585072014e-308, 1e-300, 4.9e-200}) {
    asp_description description = bench_probe();
    description.force_newton_per_count = value;
    const double got = json::parse(written(description))["force_newton_per_count"].get<double>();
    EXPECT_NEAR(got / value, 1.0, 1e-8) << value;
  }
}

TEST(FirmwareDescription, RefusesFiguresOutOfTheDocumentsRange) {
  const auto refused = [](auto change) {
    asp_description description = bench_probe();
    change(description);
    return written(description).empty();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -1.0, -infinity, 1.1e12}) {
    EXPECT_TRUE(refused([&](auto& d) { d.rate_hz = bad; }));
    EXPECT_TRUE(refused([&](auto& d) { d.force_rate_hz = bad; }));
    EXPECT_TRUE(refused([&](auto& d) { d.accel_counts_per_mps2 = bad; }));
    EXPECT_TRUE(refused([&](auto& d) { d.gyro_counts_per_radps = bad; }));
    EXPECT_TRUE(refused([&](auto& d) { d.force_newton_per_count = bad; }));
  }
  EXPECT_TRUE(refused([](auto& d) { d.force_axes = 2; }));
  EXPECT_TRUE(refused([](auto& d) { d.adc_min = d.adc_max; }));
  EXPECT_FALSE(refused([](auto&) {}));
}

TEST(FirmwareDescription, WritesNoByteBeyondItsBuffer) {
  const asp_description description = bench_probe();
  const std::size_t size = written(description).size();
  for (std::size_t capacity = 0; capacity < size; ++capacity) {
    std::string out(capacity + 4, '#');
    EXPECT_EQ(asp_write_description(&description, reinterpret_cast<std::uint8_t*>(out.data()), capacity), 0u);
    EXPECT_EQ(out.substr(capacity), "####");
  }
}

}  // namespace
}  // namespace asperity
