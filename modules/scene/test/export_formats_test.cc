// The files for phones and of haptic vibrations, each read back by the rules that its format states, not by what wrote
// it.
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/scene/export_scene.h"
#include "asperity/scene/format_hjif.h"
#include "asperity/scene/vibration_envelope.h"
#include "painted_scene.h"

namespace asperity {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

TEST(VibrationEnvelope, KnowsAmplitudeAndFrequencyOfASine) {
  for (const double frequency_Hz : {40.0, 150.0, 1000.0}) {
    std::vector<double> a;
    for (int i = 0; i < 8000; ++i) a.push_back(2.5 * std::sin(2.0 * kPi * frequency_Hz * i / 8000.0 + 0.3));
    const auto points = vibration_envelope(a, 8000.0, 0.1);  // whole periods of each
    ASSERT_EQ(points.size(), 10u);
    for (std::size_t i = 1; i < points.size(); ++i) {  // the first window has no sample before it
      EXPECT_NEAR(points[i].t_s, 0.05 + 0.1 * static_cast<double>(i), 1e-12);
      EXPECT_NEAR(points[i].amplitude, 2.5, 1e-9);
      EXPECT_NEAR(points[i].frequency_Hz, frequency_Hz, 1e-6 * frequency_Hz);
    }
  }
  EXPECT_EQ(vibration_envelope(std::vector<double>(100, 0.0), 1000.0, 0.01).front().frequency_Hz, 0.0);
  EXPECT_THROW(vibration_envelope(std::vector<double>{std::nan("")}, 1000.0, 0.01), Error);
  EXPECT_THROW(vibration_envelope(std::vector<double>{0.0}, 0.0, 0.01), Error);
}

// Apple, "Representing haptic patterns in AHAP files": the keys, and the ranges of the parameters.
TEST(FormatAhap, KeepsTheRulesOfApplesPatterns) {
  ExportConfig config;
  config.stroke.duration_s = 35.0;  // longer than one continuous event may be
  config.stroke.speed_mps = 0.25;   // 2.5 mm: 100 Hz
  const json ahap = json::parse(exported(painted_scene(), ExportFormat::kAhap, config).at("cosine.ahap"));
  EXPECT_EQ(ahap.at("Version"), 1.0);
  EXPECT_THAT(ahap.at("Metadata").at("Description").get<std::string>(), HasSubstr("m/s"));
  double events_s = 0.0;
  std::map<std::string, int> points;
  std::map<std::string, double> first_s;
  for (const json& item : ahap.at("Pattern")) {
    ASSERT_EQ(item.size(), 1u);
    if (item.contains("Event")) {
      const json& event = item.at("Event");
      EXPECT_EQ(event.at("EventType"), "HapticContinuous");
      EXPECT_NEAR(event.at("Time").get<double>(), events_s, 1e-9);
      EXPECT_LE(event.at("EventDuration").get<double>(), 30.0);
      events_s += event.at("EventDuration").get<double>();
      for (const json& parameter : event.at("EventParameters")) {
        EXPECT_GE(parameter.at("ParameterValue").get<double>(), 0.0);
        EXPECT_LE(parameter.at("ParameterValue").get<double>(), 1.0);
      }
      continue;
    }
    const json& curve = item.at("ParameterCurve");
    const std::string id = curve.at("ParameterID");
    const double begin_s =
        curve.at("Time").get<double>() + curve.at("ParameterCurveControlPoints").at(0).at("Time").get<double>();
    if (!first_s.contains(id)) first_s[id] = begin_s;
    first_s[id] = std::min(first_s[id], begin_s);
    EXPECT_LE(curve.at("ParameterCurveControlPoints").size(), 16u);
    for (const json& point : curve.at("ParameterCurveControlPoints")) {
      ++points[id];
      const double value = point.at("ParameterValue");
      if (id == "HapticIntensityControl") {
        EXPECT_NEAR(value, 1.0, 0.02);  // a sine stroked evenly
      } else {
        // (100 − 65)/(300 − 65); windows of 20 ms hold two periods. The first has no sample before it.
        EXPECT_NEAR(value, 35.0 / 235.0, 0.02);
      }
    }
  }
  EXPECT_NEAR(events_s, 35.0, 1e-9);
  // A point for each window and one at the beginning: before a curve's first point the event is at full intensity.
  EXPECT_EQ(points.at("HapticIntensityControl"), 1751);
  EXPECT_EQ(points.at("HapticSharpnessControl"), 1751);
  EXPECT_EQ(first_s.at("HapticIntensityControl"), 0.0);
  EXPECT_EQ(first_s.at("HapticSharpnessControl"), 0.0);
}

// The rules of HapsEncoder in MPEGGroup/HapticReferenceSoftware: numbers have a decimal point (rapidjson's IsDouble),
// positions are not negative, values within 0 and 1.
TEST(FormatHaps, KeepsTheRulesOfTheReferenceReader) {
  ExportConfig config;
  config.stroke.speed_mps = 0.25;
  const json haps = json::parse(exported(painted_scene(), ExportFormat::kHaps, config).at("cosine.haps"));
  EXPECT_EQ(haps.at("version"), "6");
  EXPECT_TRUE(haps.at("description").is_string());
  const json& range = haps.at("vibration").at("frequency_range");
  const double low = range.at("min"), high = range.at("max");
  EXPECT_TRUE(range.at("min").is_number_float() && range.at("max").is_number_float());
  EXPECT_LT(low, high);
  const json& note = haps.at("vibration").at("melodies").at(0).at("notes").at(0);
  EXPECT_TRUE(note.at("position").is_number_float() && note.at("length").is_number_float());
  EXPECT_EQ(note.at("waveform"), "Sine");
  EXPECT_NEAR(note.at("length").get<double>(), 2.0, 1e-9);
  for (const char* curve : {"amplitude", "pitch"}) {
    double last = -1.0;
    for (const json& frame : note.at(curve).at("keyframes")) {
      ASSERT_TRUE(frame.at("position").is_number_float() && frame.at("value").is_number_float());
      EXPECT_GT(frame.at("position").get<double>(), last);
      last = frame.at("position");
      const double value = frame.at("value");
      EXPECT_GE(value, 0.0);
      EXPECT_LE(value, 1.0);
      if (std::string(curve) == "pitch") {
        EXPECT_NEAR(low + value * (high - low), 100.0, 4.0);
      }
    }
  }
}

// The checks of IOJson::loadFile and semanticConformanceCheckExperience in MPEGGroup/HapticReferenceSoftware.
void expect_conformant(const json& hjif) {
  EXPECT_THAT(hjif.at("version").get<std::string>(), testing::MatchesRegex("20(2[3-9]|[3-9][0-9])"));
  EXPECT_EQ(hjif.at("profile"), "Main");
  EXPECT_TRUE(hjif.at("level") == 1 || hjif.at("level") == 2);
  EXPECT_THAT(hjif.at("date").get<std::string>(), testing::MatchesRegex("[0-9][0-9][0-9][0-9]"));
  EXPECT_TRUE(hjif.at("description").is_string() && hjif.at("avatars").is_array() && hjif.at("syncs").is_array());
  EXPECT_GE(hjif.at("timescale").get<int>(), 1);
  EXPECT_LE(hjif.at("timescale").get<int>(), 48000);
  std::set<int> ids;
  for (const json& perception : hjif.at("perceptions")) {
    EXPECT_TRUE(ids.insert(perception.at("id").get<int>()).second);
    EXPECT_EQ(perception.at("avatar_id"), 0);  // unspecified
    EXPECT_TRUE(perception.at("description").is_string() && perception.at("effect_library").is_array());
    EXPECT_TRUE(perception.at("unit_exponent").is_number_integer());
    std::set<int> channels;
    for (const json& channel : perception.at("channels")) {
      EXPECT_TRUE(channels.insert(channel.at("id").get<int>()).second);
      EXPECT_TRUE(channel.at("gain").is_number() && channel.at("mixing_coefficient").is_number());
      EXPECT_TRUE(channel.at("body_part_mask").is_number_unsigned() && channel.at("description").is_string());
      EXPECT_LE(channel.at("bands").size(), 7u);
      for (const json& band : channel.at("bands")) {
        EXPECT_EQ(band.at("band_type"), "Curve");
        EXPECT_EQ(band.at("curve_type"), "Linear");
        EXPECT_LE(band.at("lower_frequency_limit").get<int>(), band.at("upper_frequency_limit").get<int>());
        for (const json& effect : band.at("effects")) {
          EXPECT_EQ(effect.at("effect_type"), "Basis");
          EXPECT_EQ(effect.at("base_signal"), "Sine");
          EXPECT_TRUE(effect.at("position").is_number_integer() && effect.at("phase").is_number());
          for (const json& frame : effect.at("keyframes")) {
            EXPECT_LE(frame.at("relative_position").get<int>(), 65535);
            EXPECT_LE(std::abs(frame.at("amplitude_modulation").get<double>()), 1.0);
          }
        }
      }
    }
  }
}

const json& perception_of(const json& hjif, const std::string& modality) {
  for (const json& perception : hjif.at("perceptions"))
    if (perception.at("perception_modality") == modality) return perception;
  throw Error("no perception " + modality);
}

TEST(FormatHjif, HasTheTextureItsStiffnessAndItsFriction) {
  const json hjif = json::parse(exported(painted_scene(), ExportFormat::kHjif).at("cosine.hjif"));
  expect_conformant(hjif);
  const json& texture = perception_of(hjif, "VibrotactileTexture");
  EXPECT_EQ(texture.at("unit_exponent"), -6);
  const json& channel = texture.at("channels").at(0);
  const double gain_m = channel.at("gain");
  const json& frames = channel.at("bands").at(0).at("effects").at(0).at("keyframes");
  ASSERT_EQ(frames.size(), 201u);  // 10 mm in steps of 50 µm, both ends
  for (const json& frame : frames) {
    const double x_mm = 1e-3 * frame.at("relative_position").get<double>();
    EXPECT_NEAR(gain_m * frame.at("amplitude_modulation").get<double>(), 1e-4 * std::cos(2.0 * kPi * x_mm / 2.5),
                1e-15);
  }
  const json& force = perception_of(hjif, "Stiffness").at("channels").at(0);
  const json& line = force.at("bands").at(0).at("effects").at(0).at("keyframes");
  const double depth_m = 1e-6 * line.at(1).at("relative_position").get<double>();
  EXPECT_NEAR(force.at("gain").get<double>() * line.at(1).at("amplitude_modulation").get<double>() / depth_m, 400.0,
              1e-9);
  const json& rubbing = perception_of(hjif, "Friction").at("channels").at(0);
  EXPECT_NEAR(
      rubbing.at("gain").get<double>() *
          rubbing.at("bands").at(0).at("effects").at(0).at("keyframes").at(0).at("amplitude_modulation").get<double>(),
      0.3, 1e-12);
}

// A curve longer than an effect can be is cut where both parts have a keyframe: evaluated, it is the same curve.
TEST(FormatHjif, CutsLongCurvesIntoEffects) {
  HapticExperience experience;
  experience.perceptions.emplace_back();
  HapticChannel& channel = experience.perceptions[0].channels.emplace_back();
  for (int i = 0; i <= 200; ++i) channel.keyframes.push_back({1000 * i, std::sin(0.1 * i)});
  const json hjif = json::parse(format_hjif(experience));
  expect_conformant(hjif);
  std::map<std::int64_t, double> frames;
  const json& effects = hjif.at("perceptions")[0].at("channels")[0].at("bands")[0].at("effects");
  EXPECT_EQ(effects.size(), 4u);
  std::int64_t end = 0;
  for (const json& effect : effects) {
    EXPECT_EQ(effect.at("position").get<std::int64_t>(), end);  // no gap
    for (const json& frame : effect.at("keyframes")) {
      end = effect.at("position").get<std::int64_t>() + frame.at("relative_position").get<std::int64_t>();
      frames[end] = frame.at("amplitude_modulation");
    }
  }
  ASSERT_EQ(frames.size(), 201u);
  for (int i = 0; i <= 200; ++i) EXPECT_EQ(frames.at(1000 * i), std::sin(0.1 * i));
}

TEST(FormatHjif, RefusesWhatIsNoCurve) {
  HapticExperience experience;
  EXPECT_THROW(format_hjif(experience), Error);
  experience.perceptions.emplace_back().channels.emplace_back();
  EXPECT_THROW(format_hjif(experience), Error);
  experience.perceptions[0].channels[0].keyframes = {{0, 0.0}, {10, 1.5}};
  EXPECT_THROW(format_hjif(experience), Error);
  experience.perceptions[0].channels[0].keyframes = {{0, 0.0}, {0, 0.5}};
  EXPECT_THROW(format_hjif(experience), Error);
  experience.perceptions[0].channels[0].keyframes = {{0, 0.0}, {100000, 0.5}};
  EXPECT_THROW(format_hjif(experience), Error);
}

TEST(ExportScene, AWarningIsInTheFile) {
  Scene scene = painted_scene();
  scene.objects[0].textures[0].warning = "invalid: the tip was in the air";
  const std::map<ExportFormat, std::string> where{
      {ExportFormat::kObj, "plate.mtl"},         {ExportFormat::kGltf, "plate.glb"},
      {ExportFormat::kUsda, "plate.usda"},       {ExportFormat::kPng, "cosine.images.json"},
      {ExportFormat::kWav, "cosine.sound.json"}, {ExportFormat::kAhap, "cosine.ahap"},
      {ExportFormat::kHaps, "cosine.haps"},      {ExportFormat::kHjif, "cosine.hjif"},
      {ExportFormat::kHmpg, "cosine.hmpg"}};
  for (const auto& [format, name] : where) {
    EXPECT_THAT(exported(scene, format).at(name), HasSubstr("the tip was in the air")) << name;
    EXPECT_THAT(exported(painted_scene(), format).at(name), testing::Not(HasSubstr("arning"))) << name;
  }
  for (const ExportFormat format : {ExportFormat::kX3p, ExportFormat::kStl}) {
    ExportConfig coarse;
    coarse.relief.spacing_mm = 1.0;
    const ExportResult result = export_scene(scene, format, coarse);
    ASSERT_FALSE(result.problems.empty());
    EXPECT_EQ(result.problems[0].kind, "warning");
  }
}

TEST(ExportScene, NamesWhatAFormatCannotHold) {
  Scene scene = painted_scene();
  scene.objects[0].textures[0].texture.compliance_kc = 0.2;
  scene.static_friction_ratio = 1.5;
  for (const ExportFormat format :
       {ExportFormat::kGltf, ExportFormat::kObj, ExportFormat::kHjif, ExportFormat::kHmpg}) {
    std::string all;
    for (const Problem& problem : export_scene(scene, format).problems) {
      EXPECT_EQ(problem.kind, "not_exported");
      all += problem.message + "\n";
    }
    EXPECT_THAT(all, testing::AllOf(HasSubstr("sticking"), HasSubstr("compliance")));
  }
}

}  // namespace
}  // namespace asperity
