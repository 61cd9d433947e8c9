// Recordings of the second simulator, each with its truth.
//
//   second_bench [--seed 1] [--count 1] [--family sine|…] [--probe open|what] -o FOLDER
//
// FOLDER/SEED/ is a recording. docs/second-bench.md has the physics.

#include <cstdio>
#include <exception>
#include <string>

#include "../read_options.h"
#include "second_scan.h"

int main(int argc, char** argv) {
  try {
    std::uint64_t seed = 1, count = 1;
    std::string family, probe, folder;
    bench::read_options(
        argc, argv,
        {{"--seed", [&](auto value) { seed = static_cast<std::uint64_t>(bench::number_within(value, 0.0, 1e15)); }},
         {"--count", [&](auto value) { count = static_cast<std::uint64_t>(bench::number_within(value, 1.0, 1e5)); }},
         {"--family", [&](auto value) { family = value; }},
         {"--probe", [&](auto value) { probe = bench::is_first(value, "open", "what") ? "open" : "what"; }},
         {"-o", [&](auto value) { folder = value; }}});
    if (folder.empty()) throw asperity::Error("-o needs a folder");
    for (std::uint64_t i = seed; i < seed + count; ++i) {
      const second_bench::ScanPlan plan = second_bench::draw_plan(i, family, probe);
      second_bench::write_scan(plan, std::filesystem::path(folder) / std::to_string(i));
      std::printf("%llu %s %s\n", static_cast<unsigned long long>(i), plan.family.c_str(), plan.open ? "open" : "what");
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "second_bench: %s\n", error.what());
    return 1;
  }
}
