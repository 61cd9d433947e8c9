// The files for engines and phones, each read back by the rules that its format states, not by what wrote it.
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/geometry/read_gltf.h"
#include "asperity/geometry/read_mtl.h"
#include "asperity/geometry/read_obj.h"
#include "asperity/image/png_image.h"
#include "asperity/scene/export_scene.h"
#include "asperity/scene/format_hjif.h"
#include "asperity/scene/paint.h"
#include "asperity/scene/vibration_envelope.h"
#include "asperity/testkit/shape_meshes.h"

namespace asperity {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

// h = 0.1 mm cos(2π x / 2.5 mm) over a sample of 10 mm, painted along a plate of 30 mm x 20 mm.
Scene painted_scene() {
  Scene scene;
  scene.friction = 0.3;
  SceneObject object;
  object.mesh_file = "plate.obj";
  const TriangleMesh plate = testkit::plane_mesh({0.03, 0.02}, 15, 10);
  object.mesh.vertices = plate.vertices_m;
  object.mesh.triangles = plate.triangles;
  SceneTexture texture{1, "cosine.texture.json", {}};
  texture.texture.name = "cosine";
  texture.texture.model = Fourier1d{10.0, {0.0, 0.0, 0.0, 1e-4}, {0.0, 0.0, 0.0, 0.0}, 0.0};
  texture.texture.stiffness_N_per_m = 400.0;
  const std::vector<Vector3d> picks{{0.006, 0.011, 0.0}, {0.024, 0.011, 0.0}};
  paint(object, picks, texture);
  scene.objects.push_back(object);
  return scene;
}

std::map<std::string, std::string> exported(const Scene& scene, ExportFormat format, const ExportConfig& config = {}) {
  std::map<std::string, std::string> out;
  for (const ExportedFile& file : export_scene(scene, format, config).files) out[file.name] = file.content;
  return out;
}

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
  EXPECT_EQ(points.at("HapticIntensityControl"), 1750);
  EXPECT_EQ(points.at("HapticSharpnessControl"), 1750);
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

TEST(ExportGltf, HasTheHapticMaterialAsTheExtensionStates) {
  const std::string glb = exported(painted_scene(), ExportFormat::kGltf).at("plate.glb");
  std::uint32_t length = 0;
  for (int i = 3; i >= 0; --i) length = length << 8 | static_cast<unsigned char>(glb[12 + static_cast<std::size_t>(i)]);
  const json gltf = json::parse(glb.substr(20, length));
  EXPECT_EQ(gltf.at("extensionsUsed"), json::array({"MPEG_haptic_material"}));
  const json& materials = gltf.at("extensions").at("MPEG_haptic_material").at("materials");
  ASSERT_EQ(materials.size(), 1u);
  const json& material = materials[0];
  const auto item = [&](const char* key) {
    const json& one = material.at(key).at(0);
    EXPECT_THAT(one.at("type").get<std::string>(), testing::AnyOf("High_Resolution", "Low_Resolution"));
    EXPECT_LT(one.at("texture").at("index").get<std::size_t>(), gltf.at("textures").size());
    return one.at("extras").at("asperity");
  };
  EXPECT_EQ(item("stiffness").at("white"), 400.0);
  EXPECT_EQ(item("stiffness").at("unit"), "N/m");
  EXPECT_EQ(item("friction").at("white"), 0.3);
  EXPECT_NEAR(item("vibrotactileTexture").at("black").get<double>(), -1e-4, 1e-9);
  EXPECT_NEAR(item("vibrotactileTexture").at("white").get<double>(), 1e-4, 1e-9);
  int used = 0;
  for (const json& mesh : gltf.at("meshes"))
    if (mesh.contains("extensions"))
      used += mesh.at("extensions").at("MPEG_haptic_material").at("hapticMaterialIndex") == 0 ? 1 : 0;
  EXPECT_EQ(used, 1);
}

TEST(ExportGltf, KeepsVertexColours) {
  Scene scene = painted_scene();
  for (const Vector3d& vertex : scene.objects[0].mesh.vertices)
    scene.objects[0].mesh.vertex_colours.emplace_back(vertex.x() / 0.03, 0.5, 2.0);
  const std::string glb = exported(scene, ExportFormat::kGltf).at("plate.glb");
  EXPECT_THAT(glb, HasSubstr("COLOR_0"));
}

// The heights and normals of the MTL lie where the h lines put them: each corner's texture coordinates are its haptic
// coordinates over the size of the image, v upwards.
TEST(ExportObj, HasMapsOnTheHapticCoordinates) {
  const Scene scene = painted_scene();
  const auto files = exported(scene, ExportFormat::kObj);
  const MaterialLibrary library = parse_mtl(files.at("plate.mtl"), "plate.mtl");
  ASSERT_EQ(library.materials.size(), 2u);
  EXPECT_EQ(library.materials[0].name, "untextured");
  EXPECT_EQ(library.materials[1].normal_map, "cosine.normal.png");
  EXPECT_EQ(library.materials[1].displacement_map, "cosine.height.png");
  EXPECT_EQ(parse_png(files.at("cosine.height.png"), "heights").bits, 16);
  EXPECT_THAT(files.at("plate.mtl"), testing::AllOf(HasSubstr("stiffness 400 N/m"), HasSubstr("friction 0.3")));
  const MeshFile mesh = parse_obj(files.at("plate.obj"), "plate.obj");
  EXPECT_EQ(mesh.vertices.size(), scene.objects[0].mesh.vertices.size());
  const Eigen::Vector2d size_mm = make_texture_maps(scene.objects[0].textures[0].texture).size_mm;
  EXPECT_NEAR(size_mm.x(), 10.0, 1e-12);
  int textured = 0;
  auto part = mesh.parts.begin();
  std::int32_t material = -1;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (; part != mesh.parts.end() && part->first_triangle <= t; ++part) material = part->material;
    ASSERT_GE(material, 0);
    const std::string& name = mesh.materials[static_cast<std::size_t>(material)].name;
    EXPECT_EQ(name, mesh.haptic[t].texture == 1 ? "cosine" : "untextured");
    if (mesh.haptic[t].texture != 1) continue;
    ++textured;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& uv = mesh.texture_coordinates.at(mesh.texture_corners[t][k]);
      EXPECT_NEAR(uv.x() * size_mm.x(), mesh.haptic[t].xy_mm[k].x(), 1e-9);
      EXPECT_NEAR((1.0 - uv.y()) * size_mm.y(), mesh.haptic[t].xy_mm[k].y(), 1e-9);
    }
  }
  EXPECT_GT(textured, 10);
}

TEST(ExportUsda, StatesUnitsDisplacementAndFriction) {
  Scene scene = painted_scene();
  scene.objects[0].unit_m = 1.0;
  scene.static_friction_ratio = 1.5;
  const std::string usda = exported(scene, ExportFormat::kUsda).at("plate.usda");
  EXPECT_TRUE(usda.starts_with("#usda 1.0\n"));
  for (const char* part : {"metersPerUnit = 1\n", "physics:dynamicFriction = 0.3\n", "physics:staticFriction = 0.45",
                           "asperity:stiffness_N_per_m = 400\n",
                           "inputs:displacement.connect = </plate/Materials/cosine/height.outputs:r>",
                           "asset inputs:file = @cosine.height.png@", "float4 inputs:scale = (0.0002, 1, 1, 1)",
                           "float4 inputs:bias = (-0.0001, 0, 0, 0)", "string inputs:varname = \"haptic\""})
    EXPECT_THAT(usda, HasSubstr(part));
  // As many brackets open as close.
  for (const char* pair : {"()", "[]", "{}"})
    EXPECT_EQ(std::count(usda.begin(), usda.end(), pair[0]), std::count(usda.begin(), usda.end(), pair[1])) << pair;
}

TEST(ExportScene, AWarningIsInTheFile) {
  Scene scene = painted_scene();
  scene.objects[0].textures[0].warning = "invalid: the tip was in the air";
  const std::map<ExportFormat, std::string> where{
      {ExportFormat::kObj, "plate.mtl"},         {ExportFormat::kGltf, "plate.glb"},
      {ExportFormat::kUsda, "plate.usda"},       {ExportFormat::kPng, "cosine.images.json"},
      {ExportFormat::kWav, "cosine.sound.json"}, {ExportFormat::kAhap, "cosine.ahap"},
      {ExportFormat::kHaps, "cosine.haps"},      {ExportFormat::kHjif, "cosine.hjif"}};
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
  for (const ExportFormat format : {ExportFormat::kGltf, ExportFormat::kObj, ExportFormat::kHjif}) {
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
