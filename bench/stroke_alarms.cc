// How often a stroke that has nothing of a surface in it is taken for a touch, by kinds of noise, and how often a weak
// vibration is found: judge_stroke() over synthetic strokes at 1 kHz. Prints tables in Markdown (docs/import.md).
//
//   stroke_alarms [--strokes 10000]

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "air_strokes.h"
#include "asperity/import/measure_stroke_evidence.h"
#include "read_options.h"

namespace {

using asperity::Random;
using asperity::Stroke;
using asperity::test::AirNoise;
using asperity::test::AirStroke;

struct Row {
  const char* name;
  AirStroke made;
};

int passed(const AirStroke& made, int strokes, double vibration_mps2 = 0.0) {
  int out = 0;
  for (int k = 0; k < strokes; ++k) {
    Random random(static_cast<std::uint64_t>(k), 100 + static_cast<std::uint64_t>(made.noise));
    Stroke stroke = asperity::test::air_stroke(made, random);
    for (std::size_t i = 0; i < stroke.size() && vibration_mps2 > 0.0; ++i)
      if (stroke.speed_mps[i] > 0.0) stroke.acceleration_mps2[i] += vibration_mps2 * random.normal();
    out += is_trustworthy(judge_stroke(measure_stroke_evidence(stroke))) ? 1 : 0;
  }
  return out;
}

void print_alarms(int strokes) {
  const std::vector<Row> rows{
      {"static 0.4 s, 1 s of motion, force", {.still_s = 0.4, .moving_s = 1.0}},
      {"static 1 s, 4 s of motion, force", {.still_s = 1.0, .moving_s = 4.0}},
      {"static 0.4 s, 1 s of motion, no force", {.still_s = 0.4, .moving_s = 1.0, .has_force = false}},
      {"no static interval, 3 s of motion, no force", {.still_s = 0.0, .moving_s = 3.0, .has_force = false}},
      {"an acceleration alone, 3.5 s", {.moving_s = 3.0, .has_speed = false, .has_force = false}}};
  std::printf("| strokes of noise that are not refused, of %d |", strokes);
  for (const auto name : asperity::test::kAirNoiseNames)
    if (name != "shaken") std::printf(" %.*s |", static_cast<int>(name.size()), name.data());
  std::printf("\n|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    std::printf("| %s |", row.name);
    for (std::size_t kind = 0; kind < asperity::test::kAirNoiseNames.size(); ++kind) {
      AirStroke made = row.made;
      made.noise = static_cast<AirNoise>(kind);
      if (made.noise != AirNoise::kShaken) std::printf(" %d |", passed(made, strokes));
    }
    std::printf("\n");
  }
}

void print_shaken(int strokes) {
  std::printf("\n| a probe shaken in the air, of %d | not refused |\n|---|---|\n", strokes);
  for (const double tip_kg : {0.01, 0.02, 0.05, 0.1})
    std::printf("| force: the inertia of a tip of %g g | %d |\n", 1e3 * tip_kg,
                passed({.noise = AirNoise::kShaken, .moving_s = 3.0, .tip_kg = tip_kg}, strokes));
  std::printf("| no force, static 0.5 s (then limited: contact_unknown) | %d |\n",
              passed({.noise = AirNoise::kShaken, .moving_s = 3.0, .has_force = false}, strokes));
}

void print_found(int strokes) {
  std::printf(
      "\n| vibration over white noise, RMS | static 0.4 s, 1 s of motion | static 1 s, 4 s of motion |\n"
      "|---|---|---|\n");
  for (const double part : {0.3, 0.5, 0.7, 1.0, 2.0})
    std::printf("| %g | %.1f %% | %.1f %% |\n", part,
                100.0 * passed({.still_s = 0.4, .moving_s = 1.0}, strokes, 0.05 * part) / strokes,
                100.0 * passed({.still_s = 1.0, .moving_s = 4.0}, strokes, 0.05 * part) / strokes);
}

}  // namespace

int main(int argc, char** argv) {
  int strokes = 10000;
  try {
    bench::read_options(argc, argv, {{"--strokes", [&](std::string_view text) {
                                        strokes = static_cast<int>(bench::number_within(text, 10.0, 1e7));
                                      }}});
    print_alarms(strokes);
    print_shaken(strokes);
    print_found(strokes / 10);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stroke_alarms: %s\n", error.what());
    return 2;
  }
  return 0;
}
