#include "tables.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "asperity/base/error.h"

namespace bench {

namespace {

double percent(std::size_t part, std::size_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : kMissing;
}

double quantile(std::vector<double> x, double share) {
  x.erase(std::remove_if(x.begin(), x.end(), [](double v) { return !std::isfinite(v); }), x.end());
  if (x.empty()) return kMissing;
  std::sort(x.begin(), x.end());
  const double at = share * static_cast<double>(x.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, x.size() - 1);
  return x[below] + (at - static_cast<double>(below)) * (x[above] - x[below]);
}

std::string number(double value, int decimals = 0) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "–";
}

// The counts of one figure over some scans.
struct Tally {
  std::size_t scans = 0, values = 0, determined = 0, held = 0, easy = 0, easy_determined = 0;
  std::size_t told = 0, told_determined = 0;
  std::vector<double> error_percent, error_over_sigma;

  void add(const FigureOutcome& f) {
    if (!std::isfinite(f.truth)) return;
    ++scans;
    if (f.has_value()) {
      ++values;
      error_percent.push_back(100.0 * (f.value / f.truth - 1.0));
    }
    if (f.determined()) {
      ++determined;
      held += f.holds() ? 1 : 0;
      if (std::isfinite(f.low) && std::isfinite(f.high))
        error_over_sigma.push_back(2.0 * 1.96 * std::abs(f.value - f.truth) / (f.high - f.low));
    }
    if (f.oracle_sigma < 0.1 * std::abs(f.truth)) {
      ++easy;
      easy_determined += f.determined() ? 1 : 0;
    }
    if (f.told_sigma < 0.1 * std::abs(f.truth)) {
      ++told;
      told_determined += f.determined() ? 1 : 0;
    }
  }

  void print(const std::string& head) const {
    if (scans == 0) return;
    std::printf("| %s | %zu | %zu | %zu | %s | %zu | %s | %s | %s | %s |\n", head.c_str(), scans, values, determined,
                number(percent(held, determined), 1).c_str(), easy, number(percent(easy_determined, easy), 1).c_str(),
                number(quantile(error_over_sigma, 0.5), 2).c_str(), number(quantile(error_percent, 0.5), 2).c_str(),
                number(quantile(error_percent, 0.9) - quantile(error_percent, 0.1), 2).c_str());
  }
};

void figure_header(const char* first) {
  std::printf(
      "| %s | scans | value | determined | 95 %% holds, %% | oracle < 10 %% | of these determined, %% | median "
      "error/σ | median error, %% | 10th–90th, %% |\n|---|---|---|---|---|---|---|---|---|---|\n",
      first);
}

}  // namespace

void print_figures(const std::vector<ScanOutcome>& scans) {
  std::printf("\n## Intervals of the values (target: 90–98 %% hold, at least 90 %% determined)\n\n");
  figure_header("quantity");
  const std::vector<std::string> names = figure_names();
  std::vector<std::string> told;
  for (std::size_t k = 0; k < names.size(); ++k) {
    Tally all;
    for (const ScanOutcome& scan : scans) all.add(scan.figures[k]);
    all.print(names[k]);
    if (all.told > 0)
      told.push_back(fmt::format("| {} | {} | {} | {} | {} |", names[k], all.easy,
                                 number(percent(all.easy_determined, all.easy), 1), all.told,
                                 number(percent(all.told_determined, all.told), 1)));
  }
  std::printf(
      "\nThe oracle of the table above compared with an informed one. For pitch and depth, the first knows only the "
      "spectrum of the error and searches for the pitch; the second also knows the true pitch within 8 %%. The scans "
      "that only the second one counts hold no pitch that could be found without that knowledge. For Rsk and Rku, the "
      "first subtracts the noise's cumulants; the second does not. Its value is near the surface's where both are "
      "Gaussian, for any noise.\n\n"
      "| quantity | oracle < 10 %% | of these determined, %% | informed oracle < 10 %% | of these determined, %% |\n"
      "|---|---|---|---|---|\n");
  for (const std::string& row : told) std::printf("%s\n", row.c_str());
  std::printf("\nBy family and probe:\n\n");
  figure_header("quantity | family | probe");
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::map<std::pair<std::string, std::string>, Tally> parts;
    for (const ScanOutcome& scan : scans) parts[{scan.family, scan.probe}].add(scan.figures[k]);
    for (const auto& [part, tally] : parts) tally.print(names[k] + " | " + part.first + " | " + part.second);
  }
}

void print_false_pitches(const std::vector<ScanOutcome>& scans) {
  struct Count {
    int scans = 0, said = 0, oracle = 0;
  };
  std::map<std::pair<std::string, std::string>, Count> parts;
  for (const ScanOutcome& scan : scans) {
    if (scan.failed || scan.has_pattern || !std::isfinite(scan.correlation)) continue;
    for (const auto& part : {std::pair(std::string("all"), std::string("both")), std::pair(scan.family, scan.probe)}) {
      Count& count = parts[part];
      ++count.scans;
      count.said += scan.pattern_said ? 1 : 0;
      count.oracle += scan.oracle_pattern ? 1 : 0;
    }
  }
  std::printf(
      "\nSurfaces without a pitch of their own; `sines` hold several waves, each of which is a line. The oracle of the "
      "pitch assumes that there is a pattern. In the last column it has the same pitch in all of its twins.\n\n"
      "| family | probe | scans | called periodic | oracle has a pitch |\n|---|---|---|---|---|\n");
  for (const auto& [part, count] : parts)
    std::printf("| %s | %s | %d | %d | %d |\n", part.first.c_str(), part.second.c_str(), count.scans, count.said,
                count.oracle);
}

void print_verdicts(const std::vector<ScanOutcome>& scans) {
  struct Class {
    const char* name;
    std::function<bool(const ScanOutcome&)> has;
  };
  // What has no texture to correlate with is a scan of nothing.
  const auto r = [](const ScanOutcome& s) { return std::isfinite(s.correlation) ? s.correlation : -1.0; };
  const std::vector<Class> classes{{"nothing touched, or glass", [](const ScanOutcome& s) { return s.nothing; }},
                                   {"of these r < 0.6", [r](const ScanOutcome& s) { return s.nothing && r(s) < 0.6; }},
                                   {"r < 0.6", [r](const ScanOutcome& s) { return r(s) < 0.6; }},
                                   {"0.6 to 0.9", [r](const ScanOutcome& s) { return r(s) >= 0.6 && r(s) < 0.9; }},
                                   {"r ≥ 0.9", [r](const ScanOutcome& s) { return r(s) >= 0.9; }}};
  std::printf("\n## Verdicts (target: r < 0.6 valid at most 2 %%, r ≥ 0.9 at least 90 %%)\n\n");
  std::printf("| results | probe | scans | valid | %% |\n|---|---|---|---|---|\n");
  for (const Class& one : classes) {
    for (const char* probe : {"", "open", "what"}) {
      std::size_t count = 0, trusted = 0;
      for (const ScanOutcome& scan : scans) {
        if (!one.has(scan) || (*probe != '\0' && scan.probe != probe)) continue;
        ++count;
        trusted += scan.trusted ? 1 : 0;
      }
      std::printf("| %s | %s | %zu | %zu | %s |\n", one.name, *probe == '\0' ? "both" : probe, count, trusted,
                  number(percent(trusted, count), 1).c_str());
    }
  }
  std::printf(
      "\n| family | probe | scans | median r | lowest r | valid | invalid though r ≥ 0.9 | valid though r < 0.6 "
      "| failed |\n|---|---|---|---|---|---|---|---|---|\n");
  std::map<std::pair<std::string, std::string>, std::vector<const ScanOutcome*>> parts;
  for (const ScanOutcome& scan : scans) parts[{scan.family, scan.probe}].push_back(&scan);
  for (const auto& [part, list] : parts) {
    std::vector<double> correlations;
    std::size_t trusted = 0, refused = 0, wrong = 0, failed = 0;
    for (const ScanOutcome* scan : list) {
      correlations.push_back(scan->correlation);
      trusted += scan->trusted ? 1 : 0;
      refused += !scan->trusted && r(*scan) >= 0.9 ? 1 : 0;
      wrong += scan->trusted && r(*scan) < 0.6 ? 1 : 0;
      failed += scan->failed ? 1 : 0;
    }
    std::printf("| %s | %s | %zu | %s | %s | %zu | %zu | %zu | %zu |\n", part.first.c_str(), part.second.c_str(),
                list.size(), number(quantile(correlations, 0.5), 3).c_str(),
                number(quantile(correlations, 0.0), 3).c_str(), trusted, refused, wrong, failed);
  }
  const auto print_reasons = [&](const char* title, const std::function<bool(const ScanOutcome&)>& takes) {
    std::map<std::string, std::size_t> reasons;
    for (const ScanOutcome& scan : scans) {
      if (takes(scan)) ++reasons[scan.codes.empty() ? "valid" : scan.codes];
    }
    if (!reasons.empty()) std::printf("\n%s:\n\n", title);
    for (const auto& [reason, count] : reasons) std::printf("- %zu: %s\n", count, reason.c_str());
  };
  print_reasons("Invalid though r ≥ 0.9", [r](const ScanOutcome& s) { return !s.trusted && r(s) >= 0.9; });
  print_reasons("Valid though r < 0.6", [r](const ScanOutcome& s) { return s.trusted && r(s) < 0.6; });
  print_reasons("Invalid at r < 0.6", [r](const ScanOutcome& s) { return !s.trusted && r(s) < 0.6; });
}

void print_sigmas(const std::vector<ScanOutcome>& scans) {
  std::printf("\n## Error over stated σ, RMS of a scan (target: median 0.8–1.25, all families 0.6–1.6)\n\n");
  std::printf(
      "| family | probe | scans | position: median | 10th | 90th | height: median | 10th | 90th | texture: median "
      "| 10th | 90th | texture error over noise_rms: median | 10th | 90th | position, mm | texture error, µm | of, µm "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const auto row = [&](const std::string& head, const std::function<bool(const ScanOutcome&)>& takes) {
    std::vector<double> position, height, texture, noise, position_mm, error_um, rms_um;
    for (const ScanOutcome& scan : scans) {
      if (!takes(scan)) continue;
      position.push_back(scan.position_over_sigma);
      height.push_back(scan.height_over_sigma);
      texture.push_back(scan.texture_over_sigma);
      noise.push_back(scan.texture_error_m / scan.noise_rms_m);
      position_mm.push_back(1e3 * scan.position_rms_m);
      error_um.push_back(1e6 * scan.texture_error_m);
      rms_um.push_back(1e6 * scan.texture_rms_m);
    }
    std::printf("| %s | %zu |", head.c_str(), position.size());
    for (const auto& list : {position, height, texture, noise}) {
      for (const double share : {0.5, 0.1, 0.9}) std::printf(" %s |", number(quantile(list, share), 2).c_str());
    }
    std::printf(" %s | %s | %s |\n", number(quantile(position_mm, 0.5), 3).c_str(),
                number(quantile(error_um, 0.5), 1).c_str(), number(quantile(rms_um, 0.5), 1).c_str());
  };
  row("all | both", [](const ScanOutcome&) { return true; });
  std::set<std::pair<std::string, std::string>> parts;
  for (const ScanOutcome& scan : scans) parts.insert({scan.family, scan.probe});
  for (const auto& part : parts) {
    row(part.first + " | " + part.second,
        [&](const ScanOutcome& s) { return s.family == part.first && s.probe == part.second; });
  }
}

void print_conditions(const std::vector<ScanOutcome>& scans) {
  std::printf(
      "\n## By condition, medians\n\n| condition | probe | scans | r | position/σ | height/σ | texture/σ | length, %% "
      "| position, mm |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  std::map<std::pair<std::string, std::string>, std::vector<const ScanOutcome*>> parts;
  for (const ScanOutcome& scan : scans) {
    if (scan.nothing) continue;
    for (const std::string& condition : scan.conditions) parts[{condition, scan.probe}].push_back(&scan);
    if (scan.conditions.empty()) parts[{"none of these", scan.probe}].push_back(&scan);
  }
  for (const auto& [part, list] : parts) {
    std::vector<double> r, position, height, texture, length, position_mm;
    for (const ScanOutcome* scan : list) {
      r.push_back(scan->correlation);
      position.push_back(scan->position_over_sigma);
      height.push_back(scan->height_over_sigma);
      texture.push_back(scan->texture_over_sigma);
      length.push_back(100.0 * std::abs(scan->figures.front().value / scan->figures.front().truth - 1.0));
      position_mm.push_back(1e3 * scan->position_rms_m);
    }
    std::printf("| %s | %s | %zu |", part.first.c_str(), part.second.c_str(), list.size());
    for (const auto& column : {r, position, height, texture, length, position_mm})
      std::printf(" %s |", number(quantile(column, 0.5), 3).c_str());
    std::printf("\n");
  }
}

void print_bands(const std::vector<ScanOutcome>& scans) {
  std::printf(
      "\n## The texture's error by frequency: actual / stated by profile.noise / the surface itself, µm RMS, "
      "medians\n\n");
  std::printf("| family | probe | scans |");
  for (std::size_t b = 0; b < kBands; ++b) std::printf(" %g–%g /mm |", kBandEdges[b], kBandEdges[b + 1]);
  std::printf("\n|---|---|---|");
  for (std::size_t b = 0; b < kBands; ++b) std::printf("---|");
  std::printf("\n");
  std::map<std::pair<std::string, std::string>, std::vector<const ScanOutcome*>> parts;
  for (const ScanOutcome& scan : scans) {
    if (std::isfinite(scan.texture_error_m)) parts[{scan.family, scan.probe}].push_back(&scan);
  }
  for (const auto& [part, list] : parts) {
    std::printf("| %s | %s | %zu |", part.first.c_str(), part.second.c_str(), list.size());
    for (std::size_t b = 0; b < kBands; ++b) {
      std::vector<double> error, said, surface;
      for (const ScanOutcome* scan : list) {
        error.push_back(1e6 * scan->error_m[b]);
        said.push_back(1e6 * scan->said_m[b]);
        surface.push_back(1e6 * scan->surface_m[b]);
      }
      std::printf(" %s / %s / %s |", number(quantile(error, 0.5), 2).c_str(), number(quantile(said, 0.5), 2).c_str(),
                  number(quantile(surface, 0.5), 2).c_str());
    }
    std::printf("\n");
  }
}

void write_csv(const std::filesystem::path& path, const std::vector<ScanOutcome>& scans) {
  std::ofstream out(path);
  out.precision(10);
  out << "seed,family,probe,trusted,failed,nothing,correlation,position_over_sigma,height_over_sigma,texture_over_"
         "sigma,"
         "position_rms_m,texture_error_m,texture_rms_m,noise_rms_m,snr,snr_low,expected_correlation,stretch_"
         "correlation,process_s,codes,conditions,figure,value,"
         "low,"
         "high,truth,"
         "oracle_sigma,told_sigma\n";
  for (const ScanOutcome& s : scans) {
    for (const FigureOutcome& f : s.figures) {
      out << s.seed << ',' << s.family << ',' << s.probe << ',' << s.trusted << ',' << s.failed << ',' << s.nothing
          << ',' << s.correlation << ',' << s.position_over_sigma << ',' << s.height_over_sigma << ','
          << s.texture_over_sigma << ',' << s.position_rms_m << ',' << s.texture_error_m << ',' << s.texture_rms_m
          << ',' << s.noise_rms_m << ',' << s.snr << ',' << s.snr_low << ',' << s.expected_correlation << ','
          << s.stretch_correlation << ',' << s.process_s << ',' << s.codes << ','
          << fmt::format("{}", fmt::join(s.conditions, ";")) << ',' << f.name << ',' << f.value << ',' << f.low << ','
          << f.high << ',' << f.truth << ',' << f.oracle_sigma << ',' << f.told_sigma << '\n';
    }
  }
  if (!out) throw asperity::Error(path.string() + ": cannot be written");
}

}  // namespace bench
