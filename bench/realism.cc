// Real against rendered (docs/realism.md): what textures that are right and wrong score against a stroke that was held
// back, beside what two real strokes have.
//
//   realism [--surfaces sandpaper,clay_pot] [--materials stiff] [--strokes 3] [--repeats 1] [--seed 1] [--probe open]
//           [--speed 0.025] [--force3 yes|no] [--resonance yes|no] [--imperfection 1] [--summary yes|no]
//
// The strokes have one relief and one path, as along a guide; hand, noise, probe and calibration are each stroke's own.
// `strokes` are merged and make the texture, with the bench's true spring and friction; one more is held back and one
// more gives the ceiling. With --resonance the heights are the surface's (profile.contact_resonance_Hz of the bench's
// mass and spring). --summary: the median over the repeats instead of a row each.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/fidelity/score_realism.h"
#include "asperity/pipeline/merge_results.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/signal/spectrum.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

using asperity::RenderedRelief;

struct Choice {
  std::vector<std::string> surfaces{"sandpaper", "clay_pot"}, materials{"stiff"};
  int strokes = 3, repeats = 1;
  std::int64_t seed = 1;
  double speed_mps = 0.025, imperfection = 1.0;
  bool force3 = false, resonance = false, summary = false;
  std::string probe = "open";
};

asperity::SimulationConfig stroke_config(const Choice& choice, const std::string& surface, const std::string& material,
                                         std::int64_t line, int k) {
  asperity::SimulationConfig config = asperity::make_simulation_config(surface, choice.probe, material);
  config.seed = 1000 * line + k + 1;
  config.surface.seed = line;
  config.hand.path_seed = line;
  config.hand.speed_mps = choice.speed_mps;
  config.probe.force3 = choice.force3;
  config.calibration.imperfection = choice.imperfection;
  return config;
}

asperity::ProcessConfig as_measured(const Choice& choice, const asperity::SimulationConfig& config) {
  asperity::ProcessConfig process;
  process.profile.remove_noise = false;
  if (choice.resonance) {
    process.profile.contact_resonance_Hz =
        std::sqrt(config.contact.stiffness_N_per_m / config.hand.normal_mass_kg) / (2.0 * std::numbers::pi);
  }
  return process;
}

asperity::RealStroke real_stroke(const Choice& choice, const asperity::SimulationConfig& config,
                                 const std::string& name) {
  const asperity::Recording recording = asperity::simulate_recording(config);
  return {name, asperity::process_recording(recording, as_measured(choice, config)), recording.calibration};
}

// The heights of the merged strokes of a line.
RenderedRelief merged_relief(const Choice& choice, const std::string& surface, const std::string& material,
                             std::int64_t line) {
  std::vector<asperity::MergeStroke> strokes;
  asperity::MergeConfig merge;
  asperity::SimulationConfig config;
  for (int k = 0; k < choice.strokes; ++k) {
    config = stroke_config(choice, surface, material, line, k);
    const asperity::Recording recording = asperity::simulate_recording(config);
    strokes.push_back(asperity::stroke_of_result(asperity::process_recording(recording, as_measured(choice, config)),
                                                 recording, std::to_string(k + 1)));
  }
  asperity::Texture texture;
  texture.name = surface;
  texture.stiffness_N_per_m = config.contact.stiffness_N_per_m;
  texture.friction = config.contact.friction_dynamic + config.contact.friction_viscous_s_per_m * config.hand.speed_mps;
  asperity::Profile profile;
  if (choice.strokes > 1) {
    asperity::ProcessResult merged = asperity::merge_results(strokes, surface, merge);
    if (!merged.passes->agrees) throw asperity::Error(surface + ": the strokes do not agree");
    profile = std::move(merged.profile);
  } else {
    profile.spacing_m = strokes.front().pass.spacing_m;
    profile.texture_m = strokes.front().pass.texture_m;
  }
  return asperity::relief_of_heights(profile.texture_m, profile.spacing_m, texture, {});
}

RenderedRelief scaled(RenderedRelief relief, double heights, double stiffness, double friction) {
  for (double& h : relief.height_m) h *= heights;
  relief.contact.stiffness_N_per_m *= stiffness;
  relief.contact.friction *= friction;
  return relief;
}

// The same spectrum with random phases.
RenderedRelief random_phases(RenderedRelief relief, std::uint64_t seed) {
  asperity::Random random(seed, 1);
  std::vector<double> h = relief.height_m;
  for (double& value : h) value = std::isfinite(value) ? value : 0.0;
  std::vector<std::complex<double>> spectrum = asperity::real_dft(h);
  for (std::complex<double>& line : spectrum)
    line = std::polar(std::abs(line), 2.0 * std::numbers::pi * random.uniform());
  relief.height_m = asperity::inverse_real_dft(spectrum, h.size());
  return relief;
}

// White up to 4 cycles/mm, with the same RMS.
RenderedRelief white(RenderedRelief relief, std::uint64_t seed) {
  asperity::Random random(seed, 2);
  double square = 0.0, known = 0.0;
  std::vector<double> h(relief.height_m.size());
  for (std::size_t i = 0; i < h.size(); ++i) {
    h[i] = random.normal();
    if (!std::isfinite(relief.height_m[i])) continue;
    square += relief.height_m[i] * relief.height_m[i];
    known += 1.0;
  }
  std::vector<std::complex<double>> spectrum = asperity::real_dft(h);
  const double line = 1.0 / (1e3 * relief.spacing_m * static_cast<double>(h.size()));
  for (std::size_t k = 0; k < spectrum.size(); ++k)
    if (line * static_cast<double>(k) < 0.1 || line * static_cast<double>(k) > 4.0) spectrum[k] = 0.0;
  h = asperity::inverse_real_dft(spectrum, h.size());
  const double scale = std::sqrt(square / known) / asperity::rms(h);
  for (double& value : h) value *= scale;
  relief.height_m = std::move(h);
  return relief;
}

using Rows = std::vector<std::pair<std::string, std::vector<asperity::RealismScore>>>;

void add(Rows& rows, const std::string& name, asperity::RealismScore score) {
  for (auto& [known, scores] : rows)
    if (known == name) return scores.push_back(std::move(score));
  rows.emplace_back(name, std::vector<asperity::RealismScore>{std::move(score)});
}

double median_of(const std::vector<asperity::RealismScore>& scores,
                 const std::function<double(const asperity::RealismScore&)>& value) {
  std::vector<double> values;
  for (const asperity::RealismScore& score : scores)
    if (std::isfinite(value(score))) values.push_back(value(score));
  return values.empty() ? std::nan("") : asperity::median(values);
}

void print(const std::string& surface, const Rows& rows) {
  for (const auto& [name, scores] : rows) {
    const auto mid = [&](const std::function<double(const asperity::RealismScore&)>& value) {
      return median_of(scores, value);
    };
    double worst = 0.0;
    for (const auto& score : scores) worst = std::max(worst, score.score);
    int placed = 0;
    for (const auto& score : scores) placed += score.alignment.agrees ? 1 : 0;
    std::printf(
        "| %s | %s | %.3f | %.3f to %.3f | %.3f | %.3f | %.1f | %+.1f | %.3f | %.1f | %+.1f | %.2f | %d of %zu |\n",
        surface.c_str(), name.c_str(), mid([](const auto& s) { return s.score; }),
        mid([](const auto& s) { return s.low; }), mid([](const auto& s) { return s.high; }), worst,
        mid([](const auto& s) { return s.acceleration.rendered.correlation; }),
        mid([](const auto& s) { return s.acceleration.rendered.distance_dB; }),
        mid([](const auto& s) { return s.acceleration.rendered.level_dB; }),
        mid([](const auto& s) { return s.force.rendered.correlation; }),
        mid([](const auto& s) { return s.force.rendered.distance_dB; }),
        mid([](const auto& s) { return s.force.rendered.level_dB; }),
        mid([](const auto& s) { return s.friction.score; }), placed, scores.size());
    std::fflush(stdout);
  }
}

void run(const Choice& choice, const std::string& surface, const std::string& material) {
  Rows rows;
  const std::string title = surface + ", " + material;
  for (int i = 0; i < choice.repeats; ++i) {
    const std::int64_t line = choice.seed + i;
    const RenderedRelief right = merged_relief(choice, surface, material, line);
    const RenderedRelief elsewhere = merged_relief(choice, surface, material, line + 500);
    const RenderedRelief other_surface =
        merged_relief(choice, surface == "sandpaper" ? "clay_pot" : "sandpaper", material, line);
    const asperity::RealStroke held =
        real_stroke(choice, stroke_config(choice, surface, material, line, 100), "held back");
    const std::vector<asperity::RealStroke> others{
        real_stroke(choice, stroke_config(choice, surface, material, line, 101), "other")};
    asperity::RealismConfig config;
    const double damping = stroke_config(choice, surface, material, line, 0).contact.damping_ratio;
    config.probe.contact_damping_ratio = damping;
    const auto score = [&](const std::string& name, const RenderedRelief& relief) {
      asperity::RealismScore result = asperity::score_realism(relief, held, others, config);
      if (name == "right") {
        std::printf(
            "# %s %lld: ceiling %.3f (%.3f to %.3f), correlation %.3f and %.3f, spectra %.1f and %.1f dB; hand "
            "%.1f g, %.2f N s/m, %.0f N/m, explains %.2f; tangential share real %.3f rendered %.3f other %.3f\n",
            title.c_str(), static_cast<long long>(line), result.ceiling, result.ceiling_low, result.ceiling_high,
            result.acceleration.ceiling_correlation, result.force.ceiling_correlation,
            result.acceleration.ceiling_distance_dB, result.force.ceiling_distance_dB, 1e3 * result.hand.mass_kg,
            result.hand.damping_N_s_per_m, result.hand.stiffness_N_per_m, result.hand.explained, result.friction.real,
            result.friction.rendered, result.friction.other);
        std::fflush(stdout);
      }
      add(rows, name, std::move(result));
    };
    score("right", right);
    config.probe.contact_damping_ratio = damping > 0.2 ? 0.15 : 0.4;
    score("another damping of the contact", right);
    config.probe.contact_damping_ratio = damping;
    for (const double factor : {1.25, 1.5, 2.0, 0.75, 0.5, 0.25}) {
      char name[40];
      std::snprintf(name, sizeof name, "heights × %g", factor);
      score(name, scaled(right, factor, 1.0, 1.0));
    }
    score("heights × −1", scaled(right, -1.0, 1.0, 1.0));
    for (const double factor : {4.0, 16.0, 0.25, 0.0625}) {
      char name[40];
      std::snprintf(name, sizeof name, "stiffness × %g", factor);
      score(name, scaled(right, 1.0, factor, 1.0));
    }
    RenderedRelief usual = right;
    usual.contact.stiffness_N_per_m = 1000.0;
    score("stiffness 1 N/mm", usual);
    for (const double factor : {0.0, 0.5, 2.0, 4.0}) {
      char name[40];
      std::snprintf(name, sizeof name, "friction × %g", factor);
      score(name, scaled(right, 1.0, 1.0, factor));
    }
    score("noise, the same spectrum", random_phases(right, static_cast<std::uint64_t>(line)));
    score("noise, white", white(right, static_cast<std::uint64_t>(line)));
    score("another line", elsewhere);
    score("another surface", other_surface);
    if (!choice.summary) {
      print(title + " " + std::to_string(line), rows);
      rows.clear();
    }
  }
  print(title, rows);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Choice choice;
    bench::read_options(argc, argv,
                        {{"--surfaces", bench::list_into(choice.surfaces)},
                         {"--materials", bench::list_into(choice.materials)},
                         {"--strokes", bench::whole_into(choice.strokes, 1.0, 50.0)},
                         {"--repeats", bench::whole_into(choice.repeats, 1.0, 1e4)},
                         {"--seed", bench::whole_into(choice.seed, 1.0, 1e9)},
                         {"--speed", bench::number_into(choice.speed_mps, 1e-3, 1.0)},
                         {"--imperfection", bench::number_into(choice.imperfection, 0.0, 100.0)},
                         {"--force3", bench::yes_into(choice.force3)},
                         {"--resonance", bench::yes_into(choice.resonance)},
                         {"--summary", bench::yes_into(choice.summary)},
                         {"--probe", bench::text_into(choice.probe)}});
    std::printf(
        "| surface | rendered | score | 95 %% | largest | acceleration: correlation | spectra, dB | level, dB | "
        "force: correlation | spectra, dB | level, dB | friction | placed |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& surface : choice.surfaces)
      for (const std::string& material : choice.materials) run(choice, surface, material);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "realism: %s\n", error.what());
    return 1;
  }
}
