#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/import/stroke_file.h"
#include "asperity/json/config_json.h"
#include "asperity/profile/read_heights.h"
#include "asperity/session/texture_input.h"
#include "asperity/texture/compare_textures.h"
#include "asperity/texture/compare_vibrations.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/sample_heights.h"
#include "asperity/texture/texture_file.h"
#include "commands.h"
#include "json_of.h"
#include "option_units.h"
#include "stroke_input.h"
#include "units_json.h"

namespace asperity::app {

namespace {

struct CompareSettings {
  ReadHeightsConfig input;
  CompareTexturesConfig compare;
  CompareVibrationsConfig vibration;
  double force_N = 1.0;
  double length_mm = 40.0;
  double spacing_mm = 0.025;

  template <class V>
  void visit(V& v) {
    v.group("input", input);
    v.group("compare", compare);
    v.group("vibration", vibration);
    v.field("force_N", force_N, "of the hand, for forces in time where no stroke states it", {0.0, 100.0});
    v.field("length_mm", length_mm, "of the lines that are taken through a texture", {1e-3, 1e6});
    v.field("spacing_mm", spacing_mm, "of their heights", {1e-6, 1e3});
  }
};

constexpr const char* kSame = "same to the hand";
constexpr const char* kNoticeable = "noticeable";

const char* word_of(HandVerdict verdict) {
  return verdict == HandVerdict::kSame ? kSame : verdict == HandVerdict::kNoticeable ? kNoticeable : "not determined";
}

Json noticeable_json(HandVerdict verdict) {
  return verdict == HandVerdict::kUndetermined ? Json(nullptr) : Json(verdict == HandVerdict::kNoticeable);
}

// A value without a threshold has no verdict.
Json to_json(const Difference& d) {
  return {{"a", number_or_null(d.a)},
          {"b", number_or_null(d.b)},
          {"percent", number_or_null(d.percent)},
          {"uncertainty_percent", number_or_null(d.uncertainty_percent)},
          {"jnd_percent", number_or_null(d.jnd_percent)},
          {"verdict", std::isfinite(d.jnd_percent) ? Json(word_of(d.verdict)) : Json(nullptr)}};
}

// A value that is not known, or a percentage of 0, is printed as a dash; one of next to nothing has a bound.
std::string cell(const char* form, double value, std::string_view unit_text, std::size_t width) {
  constexpr double kMost_percent = 1e6;
  std::string out = std::isfinite(value) ? fmt::format(fmt::runtime(form), value).append(unit_text) : "–";
  if (unit_text == " %" && std::isfinite(value) && std::abs(value) > kMost_percent)
    out = value > 0.0 ? "> 1e6 %" : "< -1e6 %";
  const std::size_t letters = std::isfinite(value) ? out.size() : 1;
  return letters < width ? std::string(width - letters, ' ') + out : out;
}

std::string format_row(const std::string& name, const Difference& d, double unit, const std::string& note) {
  return fmt::format("{:<22} {} {} {} {} {}  {}\n", name, cell("{:.5g}", d.a * unit, "", 11),
                     cell("{:.5g}", d.b * unit, "", 11), cell("{:+.2f}", d.percent, " %", 11),
                     cell("{:.2g}", d.uncertainty_percent, " %", 9), cell("{:.3g}", d.jnd_percent, " %", 9), note);
}

class TextureCompareCommand : public Command {
 public:
  explicit TextureCompareCommand(Parser& root)
      : Command(root, "compare", "Differences between two textures, profiles or strokes that a hand would notice") {
    require(parser().add_option("A", a_, "A *.texture.json, a profile.csv, heights, or a stroke's folder"));
    require(parser().add_option("B", b_, "The other"));
    parser().add_option("--speed", speed_, "Speed of the hand")->type_name("SPEED");
    parser()
        .add_option("--force", force_, "Force of the hand, for forces in time where no stroke states it; default: 1N")
        ->type_name("FORCE");
    parser()
        .add_option("--spacing", spacing_, "Distance of the heights, for files without positions")
        ->type_name("LENGTH");
  }

  std::vector<ConfigField> fields() override { return list_fields("", settings_); }

  void apply_options() override {
    if (!speed_.empty()) settings_.compare.speed_mps = speed_option_mps("--speed", speed_);
    constexpr double kMostForce_N = 100.0;
    if (!force_.empty()) settings_.force_N = force_option_N("--force", force_, kMostForce_N);
    if (!spacing_.empty()) settings_.input.spacing_m = length_option_m("--spacing", spacing_);
  }

  int run(const Observer& observer) override {
    if (is_vibration(a_, observer) || is_vibration(b_, observer)) {
      report_vibrations(observer);
      return kDone;
    }
    std::vector<FileUnits> units;
    const ComparedSurface a = surface_of(a_, units, observer), b = surface_of(b_, units, observer);
    const TextureComparison c = compare_textures(a, b, settings_.compare);
    Json out;
    out["format"] = "asperity-texture-comparison";
    out["version"] = 1;
    out["a"] = a_;
    out["b"] = b_;
    out["verdict"] = word_of(c.verdict);
    out["noticeable"] = noticeable_json(c.verdict);
    out["units"] = units_json(units);
    out["other_shape"] = c.other_shape;
    out["band_cycles_per_mm"] = {c.low_cycles_per_mm, c.high_cycles_per_mm};
    out["roughness"] = Json::object();
    for (const auto& [name, difference] : c.roughness) out["roughness"][name] = to_json(difference);
    out["mean_frequency_per_mm"] = to_json(c.frequency_per_mm);
    out["bands"] = Json::array();
    out["bands_left_out"] = Json::array();
    for (const auto& band : c.bands) {
      if (!band.is_resolved) {
        out["bands_left_out"].push_back({band.low_cycles_per_mm, band.high_cycles_per_mm});
        continue;
      }
      Json one = to_json(band.rms_m);
      one["low_cycles_per_mm"] = band.low_cycles_per_mm;
      one["high_cycles_per_mm"] = band.high_cycles_per_mm;
      one["felt"] = band.counts();
      if (!band.counts()) one["verdict"] = kSame;
      out["bands"].push_back(one);
    }
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    say_table(c, units_lines(units));
    return kDone;
  }

 private:
  // Compared over frequency: a stroke, or a force in time.
  static bool is_vibration(const std::string& file, const Observer& observer) {
    if (is_stroke_folder(file)) return true;
    return is_texture_file(file) && !is_height_field(read_texture(file, {}, observer).model);
  }

  struct Side {
    ComparedVibration vibration;
    std::vector<double> speed_mps, force_N;  // of its pieces; empty: not known
    std::string text;
  };

  // A texture's vibration at the speeds and forces of the other side's stroke where it states them, else at those of
  // the settings.
  Side rendered_side(const std::string& file, const Side& other, const Observer& observer) const {
    if (!is_texture_file(file))
      throw Error(printable(file, 200) +
                  ": heights of a file cannot be compared with vibrations; fit a texture to them first");
    constexpr std::size_t kPieces = 1000;  // leave 1.4 % in the lowest octave, below what is noticed
    constexpr double kPiece_s = 0.25, kRate_Hz = 8000.0;
    Side out;
    out.speed_mps = other.speed_mps;
    if (out.speed_mps.empty()) out.speed_mps.assign(std::max(kPieces, other.force_N.size()), speed_mps());
    out.force_N = other.force_N;
    if (out.force_N.empty()) out.force_N.assign(out.speed_mps.size(), settings_.force_N);
    out.speed_mps.resize(out.force_N.size(), speed_mps());
    const double rate_Hz = other.vibration.rate_Hz > 0.0 ? other.vibration.rate_Hz : kRate_Hz;
    out.vibration = vibration_of(read_texture(file, {}, observer), out.speed_mps, out.force_N, rate_Hz, kPiece_s);
    out.text = fmt::format("{}: rendered at {}, {}\n", printable(file, 200),
                           other.speed_mps.empty() ? fmt::format("{:.3g} mm/s", 1e3 * speed_mps())
                                                   : std::string("the speeds of the other's stroke"),
                           other.force_N.empty() ? fmt::format("{:.3g} N", settings_.force_N)
                                                 : std::string("the forces of the other's stroke"));
    return out;
  }

  double speed_mps() const { return settings_.compare.speed_mps; }

  static Side recorded_side(const std::string& folder) {
    const Stroke stroke = read_valid_stroke(folder);
    StrokeVibration found = vibration_of_stroke(stroke);
    Side out{std::move(found.vibration), std::move(found.speed_mps), std::move(found.force_N), ""};
    out.text =
        fmt::format("{}: {} windows of 0.25 s, {}, {}, {}\n", printable(folder, 200), out.vibration.pieces_mps2.size(),
                    mean_text(out.speed_mps, 1e3, "mm/s", "speed"), mean_text(out.force_N, 1.0, "N", "force"),
                    !out.vibration.noise_mps2.empty()              ? "noise subtracted"
                    : std::isfinite(out.vibration.most_noise_mps2) ? "noise as stated, in any of the bands"
                                                                   : "noise not known");
    return out;
  }

  static std::string mean_text(const std::vector<double>& values, double unit, const char* name, const char* quantity) {
    if (values.empty()) return std::string(quantity) + " not known";
    double mean = 0.0;
    for (const double v : values) mean += v / static_cast<double>(values.size());
    return fmt::format("{:.3g} {} in the mean", mean * unit, name);
  }

  void report_vibrations(const Observer& observer) {
    const bool a_recorded = is_stroke_folder(a_), b_recorded = is_stroke_folder(b_);
    Side a, b;
    if (a_recorded) a = recorded_side(a_);
    if (b_recorded) b = recorded_side(b_);
    if (!a_recorded) a = rendered_side(a_, b_recorded ? b : Side{}, observer);
    if (!b_recorded) b = rendered_side(b_, a_recorded ? a : Side{}, observer);
    const VibrationComparison c = compare_vibrations(a.vibration, b.vibration, settings_.vibration);
    Json out;
    out["format"] = "asperity-vibration-comparison";
    out["version"] = 1;
    out["a"] = a_;
    out["b"] = b_;
    out["verdict"] = word_of(c.verdict);
    out["noticeable"] = noticeable_json(c.verdict);
    out["band_Hz"] = {c.low_Hz, c.high_Hz};
    out["a_mps2"] = c.a_mps2;
    out["b_mps2"] = c.b_mps2;
    out["bands"] = Json::array();
    std::string text =
        a.text + b.text +
        fmt::format("{:<22} {:>11} {:>11} {:>11} {:>9} {:>9}\n", "RMS, m/s²", "A", "B", "difference", "±", "noticed");
    for (const VibrationBand& band : c.bands) {
      out["bands"].push_back({{"low_Hz", band.low_Hz},
                              {"high_Hz", band.high_Hz},
                              {"a_mps2", band.a_mps2},
                              {"b_mps2", band.b_mps2},
                              {"percent", number_or_null(band.percent)},
                              {"least_percent", number_or_null(band.least_percent)},
                              {"most_percent", number_or_null(band.most_percent)},
                              {"sigma_percent", number_or_null(band.sigma_percent)},
                              {"jnd_percent", band.jnd_percent},
                              {"felt", band.is_compared},
                              {"verdict", word_of(band.verdict)}});
      text += fmt::format(
          "{:<22} {:>11.4g} {:>11.4g} {} {} {}  {}\n", fmt::format("{:.4g}-{:.4g} Hz", band.low_Hz, band.high_Hz),
          band.a_mps2, band.b_mps2, cell("{:.2f}", band.percent, " %", 11), cell("{:.2g}", band.sigma_percent, " %", 9),
          cell("{:.3g}", band.jnd_percent, " %", 9), band.is_compared ? word_of(band.verdict) : "below the threshold");
    }
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    say(text + word_of(c.verdict) + "\n");
  }

  ComparedSurface surface_of(const std::string& file, std::vector<FileUnits>& units, const Observer& observer) const {
    ComparedSurface surface;
    std::vector<std::vector<double>> lines;
    if (is_texture_file(file)) {
      const Texture texture = read_texture(file, {}, observer);
      surface.spacing_m = 1e-3 * settings_.spacing_mm;
      if (!is_height_field(texture.model))
        throw Error(file + ": is a force in time, which has no spectrum over lengths");
      lines = sample_lines(texture.model, 1e-3 * settings_.length_mm, surface.spacing_m);
    } else {
      Problems problems;
      HeightsOrigin origin;
      const Heights heights = read_heights(file, settings_.input, &problems, &origin);
      units.push_back({file, origin.units});
      for (const Problem& problem : problems) print_error(printable(problem.message, 600));
      if (const auto* profile = std::get_if<HeightProfile>(&heights)) {
        surface.spacing_m = profile->spacing_m;
        lines.push_back(profile->height_m);
      } else {
        const auto& map = std::get<ArealMap>(heights);
        surface.spacing_m = map.x_spacing_m;
        for (std::size_t r = 0; r < map.rows; ++r) {
          const auto first = map.height_m.begin() + static_cast<std::ptrdiff_t>(r * map.columns);
          lines.emplace_back(first, first + static_cast<std::ptrdiff_t>(map.columns));
        }
      }
    }
    for (const auto& line : lines) {
      if (std::none_of(line.begin(), line.end(), [](double h) { return std::isfinite(h); }))
        throw Error(printable(file, 200) + ": has a line without heights");
      surface.lines_m.push_back(band_limited_heights(line, surface.spacing_m, settings_.compare));
    }
    surface.roughness = roughness_of(surface.lines_m, surface.spacing_m);
    measure_pieces(surface);
    return surface;
  }

  // Of the length of the spectrum's segments.
  void measure_pieces(ComparedSurface& surface) const {
    const auto size =
        static_cast<std::size_t>(std::max(2.0, std::round(1e-3 * settings_.compare.segment_mm / surface.spacing_m)));
    for (const auto& line : surface.lines_m) {
      for (const auto& [name, whole] : surface.roughness) surface.roughness_of_pieces[name].emplace_back();
      for (std::size_t start = 0; start + size <= line.size(); start += size) {
        const auto first = line.begin() + static_cast<std::ptrdiff_t>(start);
        const auto values =
            roughness_of({std::vector<double>(first, first + static_cast<std::ptrdiff_t>(size))}, surface.spacing_m);
        for (auto& [name, pieces] : surface.roughness_of_pieces) {
          const auto value = values.find(name);
          pieces.back().push_back(value == values.end() ? kNan : value->second);
        }
      }
    }
  }

  void say_table(const TextureComparison& c, const std::string& units) const {
    std::string text =
        units + fmt::format("{:<22} {:>11} {:>11} {:>11} {:>9} {:>9}\n", "", "A", "B", "difference", "±", "noticed");
    for (const auto& [name, d] : c.roughness) {
      const bool length = name.ends_with("_m");
      text += format_row(length ? name.substr(0, name.size() - 2) + " µm" : name, d, length ? 1e6 : 1.0,
                         std::isfinite(d.jnd_percent) ? word_of(d.verdict) : "");
    }
    text += format_row("mean cycles/mm", c.frequency_per_mm, 1.0, "");
    std::string left_out;
    for (const auto& band : c.bands) {
      const std::string name = fmt::format("{:.3g}-{:.3g} /mm", band.low_cycles_per_mm, band.high_cycles_per_mm);
      if (!band.is_resolved) {
        left_out += (left_out.empty() ? "" : ", ") + name;
        continue;
      }
      text += format_row(name + ", RMS µm", band.rms_m, 1e6,
                         band.counts() ? word_of(band.rms_m.verdict) : "below the threshold");
    }
    if (!left_out.empty())
      text += fmt::format("note: {} left out: the heights are shorter than two of its longest waves\n", left_out);
    if (c.other_shape)
      text +=
          "note: Rsk or Rku differ: hills and pits have other shapes. No threshold of perception is known for it; the "
          "verdict is of the RMS heights and RSm\n";
    say(text + fmt::format("at {:.3g} mm/s: {}\n", settings_.compare.speed_mps * 1e3, word_of(c.verdict)));
  }

  std::string a_;
  std::string b_;
  std::string speed_;
  std::string spacing_;
  std::string force_;
  CompareSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_texture_compare(Parser& root) { return std::make_unique<TextureCompareCommand>(root); }

}  // namespace asperity::app
