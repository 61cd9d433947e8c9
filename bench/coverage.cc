// Whether what the product says of its own errors is true: random scans with imperfect calibrations, faults and scans
// of nothing; each is processed with the defaults, and its figures are compared with the same figures of the truth.
// Prints tables in Markdown: how many 95 % intervals hold the truth, what is trusted, error over stated sigma.
//
//   coverage [--scans 400] [--seed 1] [--simulator ours|second] [--families sine,…] [--probes open,what]
//            [--jobs 2] [--calibration stated|exact] [--paths drawn|curved|raster] [--csv FILE]
//
// docs/coverage.md says what is drawn and how the truth's figures are had.

#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/recording/write_recording.h"
#include "coverage/judge_case.h"
#include "coverage/scan_case.h"
#include "coverage/tables.h"
#include "read_options.h"

namespace {

struct Options {
  int scans = 400;
  std::uint64_t seed = 1;
  int jobs = 2;
  bool ours = true;
  bench::CaseChoice choice;
  std::string csv;
  std::string scan, folder;  // one scan by its own number, to look at: `process` it
};

bench::CasePaths paths_of(std::string_view value) {
  if (value == "drawn") return bench::CasePaths::kDrawn;
  if (value == "curved") return bench::CasePaths::kCurved;
  if (value == "raster") return bench::CasePaths::kRaster;
  throw asperity::Error("'" + std::string(value) + "' is not drawn, curved or raster");
}

Options parse_options(int argc, char** argv) {
  Options out;
  bench::read_options(
      argc, argv,
      {{"--scans", [&](auto value) { out.scans = static_cast<int>(bench::number_within(value, 1.0, 1e6)); }},
       {"--seed", [&](auto value) { out.seed = static_cast<std::uint64_t>(bench::number_within(value, 0.0, 1e12)); }},
       {"--jobs", [&](auto value) { out.jobs = static_cast<int>(bench::number_within(value, 1.0, 256.0)); }},
       {"--simulator", [&](auto value) { out.ours = bench::is_first(value, "ours", "second"); }},
       {"--families", [&](auto value) { out.choice.families = bench::split_list(value); }},
       {"--probes", [&](auto value) { out.choice.probes = bench::split_list(value); }},
       {"--calibration", [&](auto value) { out.choice.exact_calibration = bench::is_first(value, "exact", "stated"); }},
       {"--paths", [&](auto value) { out.choice.paths = paths_of(value); }},
       {"--scan", [&](auto value) { out.scan = value; }},
       {"--folder", [&](auto value) { out.folder = value; }},
       {"--csv", [&](auto value) { out.csv = value; }}});
  return out;
}

std::vector<bench::ScanOutcome> run(const Options& options) {
  std::vector<bench::ScanOutcome> out(static_cast<std::size_t>(options.scans));
  std::atomic<std::size_t> next{0}, done{0};
  std::exception_ptr fault;
  std::mutex guard;
  const auto work = [&] {
    for (std::size_t i = next++; i < out.size(); i = next++) {
      try {
        const std::uint64_t seed = options.seed * 1'000'000 + i;
        out[i] = bench::judge_case(options.ours ? bench::simulate_own_case(seed, options.choice)
                                                : bench::simulate_second_case(seed, options.choice));
      } catch (...) {
        const std::scoped_lock lock(guard);
        fault = std::current_exception();
        next = out.size();
      }
      if (++done % 20 == 0) std::fprintf(stderr, "%zu of %zu\n", done.load(), out.size());
    }
  };
  std::vector<std::thread> workers;
  for (int k = 0; k < options.jobs; ++k) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  if (fault) std::rethrow_exception(fault);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parse_options(argc, argv);
    if (!options.scan.empty()) {
      const auto seed = static_cast<std::uint64_t>(bench::number_within(options.scan, 0.0, 1e15));
      std::filesystem::create_directories(options.folder);
      asperity::write_recording(options.folder, (options.ours ? bench::simulate_own_case(seed, options.choice)
                                                              : bench::simulate_second_case(seed, options.choice))
                                                    .recording);
      return 0;
    }
    const std::vector<bench::ScanOutcome> scans = run(options);
    double process_s = 0.0;
    for (const bench::ScanOutcome& scan : scans) process_s += scan.process_s;
    std::printf("%zu scans of %s, seed %llu\n", scans.size(),
                options.ours ? "the product's own bench" : "the second simulator",
                static_cast<unsigned long long>(options.seed));
    std::fprintf(stderr, "%.2f s of processing each\n", process_s / static_cast<double>(scans.size()));
    bench::print_verdicts(scans);
    bench::print_sigmas(scans);
    bench::print_conditions(scans);
    bench::print_bands(scans);
    bench::print_figures(scans);
    bench::print_false_pitches(scans);
    if (!options.csv.empty()) bench::write_csv(options.csv, scans);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "coverage: %s\n", error.what());
    return 1;
  }
}
