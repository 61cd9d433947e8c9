#include "stroke_input.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "asperity/base/error.h"
#include "asperity/base/interval_text.h"
#include "asperity/base/text.h"
#include "asperity/import/format_import.h"
#include "asperity/import/measure_stroke_evidence.h"
#include "asperity/import/stroke_file.h"
#include "asperity/import/stroke_spectra.h"
#include "asperity/import/stroke_windows.h"
#include "asperity/verdict/judge_stroke.h"

namespace asperity::app {

namespace {

constexpr double kWindow_s = 0.25;

std::vector<std::vector<double>> pieces_of(const Stroke& stroke, const std::vector<std::size_t>& firsts,
                                           std::size_t length) {
  std::vector<std::vector<double>> out;
  for (const std::size_t first : firsts) {
    const auto begin = stroke.acceleration_mps2.begin() + static_cast<std::ptrdiff_t>(first);
    out.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(length));
  }
  return out;
}

std::vector<double> means_of(const std::vector<double>& values, const std::vector<std::size_t>& firsts,
                             std::size_t length) {
  std::vector<double> out;
  for (const std::size_t first : firsts) {
    if (values.empty()) return {};
    double mean = 0.0;
    for (std::size_t i = first; i < first + length; ++i) mean += values[i] / static_cast<double>(length);
    out.push_back(mean);
  }
  return out;
}

const char* known_text(const std::vector<double>& values, bool measured) {
  return values.empty() ? "not known" : measured ? "measured" : "as stated";
}

}  // namespace

Stroke read_valid_stroke(const std::string& folder) {
  Stroke stroke = read_stroke_folder(folder);
  const Verdicts verdicts = judge_stroke(measure_stroke_evidence(stroke));
  if (!is_trustworthy(verdicts)) throw Error(printable(folder, 200) + ": " + verdict_sentence(verdicts));
  return stroke;
}

SeriesTable series_of_stroke(const std::string& folder) {
  Stroke stroke = read_valid_stroke(folder);
  if (stroke.speed_mps.empty())
    throw Error(printable(folder, 200) +
                ": its speed is not determined without positions; state it at the import (--stroke-speed 50mm/s)");
  if (stroke.force_N.empty())
    throw Error(printable(folder, 200) + ": its force is not determined; state it at the import (--stroke-force 1N)");
  return {std::move(stroke.acceleration_mps2), std::move(stroke.speed_mps), std::move(stroke.force_N), stroke.rate_Hz};
}

StrokeVibration vibration_of_stroke(const Stroke& stroke) {
  const StrokeWindows windows = find_stroke_windows(stroke, stroke.acceleration_mps2, kWindow_s);
  StrokeVibration out;
  out.vibration.rate_Hz = stroke.rate_Hz;
  out.vibration.pieces_mps2 = pieces_of(stroke, windows.active, windows.length);
  out.vibration.noise_mps2 = pieces_of(stroke, windows.quiet, windows.length);
  out.vibration.most_noise_mps2 = stroke.noise_mps2 > 0.0 ? stroke.noise_mps2 : std::numeric_limits<double>::infinity();
  out.speed_mps = means_of(stroke.speed_mps, windows.active, windows.length);
  out.force_N = means_of(stroke.force_N, windows.active, windows.length);
  return out;
}

std::string stroke_text(const Stroke& stroke) {
  const StrokeEvidence e = measure_stroke_evidence(stroke);
  std::string out =
      fmt::format("stroke      {:.4g} s at {:.6g} Hz, {} {} of the accelerometer; speed {}, force {}\n",
                  static_cast<double>(stroke.size()) / stroke.rate_Hz, stroke.rate_Hz, stroke.axes,
                  stroke.axes == 1 ? "axis" : "axes", known_text(stroke.speed_mps, stroke.speed_is_measured),
                  known_text(stroke.force_N, stroke.force_is_measured));
  out += fmt::format("vibration   {:.3g} m/s² RMS above 40 Hz in {:.3g} s", e.active_mps2, e.active_s);
  if (std::isfinite(e.power_ratio)) out += fmt::format(", {:.3g} m/s² in the quiet part", e.quiet_mps2);
  if (std::isfinite(e.speed_exponent))
    out += ", its power as the speed to the " + interval_text(e.speed_exponent, e.speed_exponent_sigma);
  out += "\n";
  for (const std::string& text : stroke_unknowns(stroke)) out += "not determined: " + text + "\n";
  for (const Problem& problem : stroke.problems) out += "note        " + problem.message + "\n";
  const Verdicts verdicts = judge_stroke(e);
  for (const Verdict& verdict : verdicts) out += verdict_line(verdict) + "\n";
  if (verdicts.empty()) out += "valid\n";
  return out;
}

std::string stroke_heights_text(const Stroke& stroke) {
  const StrokeHeightSpectrum spectrum = stroke_height_spectrum(stroke);
  if (spectrum.octaves.empty())
    return stroke.speed_mps.empty()
               ? "heights     not determined: without positions lengths are not known\n"
               : "heights     not determined: the speed is never steady for a quarter of a second\n";
  std::string out =
      fmt::format("heights     as the acceleration shows them, {} windows of 0.25 s, {}\n", spectrum.windows,
                  spectrum.noise_is_known ? "noise subtracted" : "with the sensor's noise, which is not known");
  out += fmt::format("{:>18} {:>12} {:>12} {:>12} {:>8}\n", "cycles/mm", "RMS µm", "± µm", "noise µm", "windows");
  for (const StrokeHeightBand& band : spectrum.octaves) {
    out += fmt::format("{:>18} {:>12.4g} {:>11} {:>11} {:>8}\n",
                       fmt::format("{:.4g}-{:.4g}", band.low_cycles_per_mm, band.high_cycles_per_mm), 1e6 * band.rms_m,
                       std::isfinite(band.rms_sigma_m) ? fmt::format("{:.2g}", 1e6 * band.rms_sigma_m) : "-",
                       spectrum.noise_is_known ? fmt::format("{:.3g}", 1e6 * band.noise_rms_m) : "-", band.windows);
  }
  return out;
}

Json stroke_heights_json(const Stroke& stroke) {
  const StrokeHeightSpectrum spectrum = stroke_height_spectrum(stroke);
  Json out;
  out["windows"] = spectrum.windows;
  out["noise_known"] = spectrum.noise_is_known;
  out["octaves"] = Json::array();
  for (const StrokeHeightBand& band : spectrum.octaves)
    out["octaves"].push_back({{"low_cycles_per_mm", band.low_cycles_per_mm},
                              {"high_cycles_per_mm", band.high_cycles_per_mm},
                              {"rms_m", band.rms_m},
                              {"rms_sigma_m", number_or_null(band.rms_sigma_m)},
                              {"noise_rms_m", spectrum.noise_is_known ? Json(band.noise_rms_m) : Json(nullptr)},
                              {"windows", band.windows}});
  return out;
}

std::string stroke_columns_text(const std::vector<ImportTable>& tables) {
  std::string out;
  for (const ImportTable& table : tables) {
    out += printable(table.table.file, 200) + " (" + role_name(table.role) +
           fmt::format("): {} rows: ", table.table.rows()) + columns_text(table.map, table.table);
    if (table.rate_Hz > 0.0) out += fmt::format(" at {:.6g} Hz", table.rate_Hz);
    out += "\n";
  }
  return out + unused_columns_text(pointers_to(tables));
}

std::vector<const ImportTable*> pointers_to(const std::vector<ImportTable>& tables) {
  std::vector<const ImportTable*> out;
  for (const ImportTable& table : tables) out.push_back(&table);
  return out;
}

}  // namespace asperity::app
