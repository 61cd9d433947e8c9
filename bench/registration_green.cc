// Whether the verdict on a registration can be believed: random cases, many of them made to go wrong, each registered
// as `asperity register` does (locate_scans) from points with the errors that a scan has, and judged. Prints a table in
// Markdown; docs/accuracy-poses.md says what it means.
//
//   registration_green [--cases 400] [--first 0] [--whole 0] [--seed 1] [--jobs 1] [--mesh FILE,…] [--each yes] [--only
//   CLASS] [--csv FILE]
//
// Wrong: more than 3 mm (RMS over the points) or 5° from the truth, modulo the motions that map the body onto itself
// (on a mesh of another size in proportion), and each result on another body's mesh, a mirror image or a mesh that is
// 10 % and more too large or small. Good: within 1 mm and 2°, where the least possible standard deviations (bound.h)
// are below 0.3 mm and 0.7°. `--whole N` adds N cases whose points come from simulated recordings (whole_case.h), to
// compare with. `--first N` begins with case N of the seed, so that a long run can be cut into pieces.
// `--each yes` prints a line a case on standard error, `--only N` runs the cases of one class. `--csv FILE` appends a
// row a case as soon as it is done: a run can be cut off, and `scripts/green_table FILE` makes the table of its rows.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <mutex>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/pipeline/locate_scans.h"
#include "asperity/pipeline/scan_evidence.h"
#include "asperity/verdict/judge_registration.h"
#include "green/bound.h"
#include "green/cases.h"
#include "green/whole_case.h"
#include "read_options.h"

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kWrong_m = 3e-3, kWrong_rad = 5.0 * kDegree;
constexpr double kGood_m = 1e-3, kGood_rad = 2.0 * kDegree;
constexpr double kBound_m = 0.3e-3, kBound_rad = 0.7 * kDegree;

struct Options {
  int cases = 400;
  int first = 0;
  int whole = 0;
  int seed = 1;
  int jobs = 1;
  int only = -1;
  std::vector<std::string> meshes;
  std::string csv;  // a file that gets a row a case; empty: none
  bool each = false;
};

struct Outcome {
  bench::CaseClass kind = bench::CaseClass::kNear;
  bool done = false, wrong = false, good = false, trusted = false;
  double time_s = 0.0;
  bench::PoseDifference off{1.0, std::numbers::pi}, bound;
  std::string codes;  // of the verdicts
};

// One row; the file's first gets the names of the columns.
void append_row(const std::string& name, int seed, int number, const bench::RegistrationCase& given,
                const Outcome& out) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  std::FILE* const file = std::fopen(name.c_str(), "a");
  if (file == nullptr) throw asperity::Error("cannot write " + name);
  if (std::ftell(file) == 0) {
    std::fprintf(file,
                 "seed,case,class,body,paths,off_mm,off_deg,bound_mm,bound_deg,wrong,good,trusted,codes,time_s\n");
  }
  std::fprintf(file, "%d,%d,%d,%s,%zu,%.3f,%.3f,%.4f,%.4f,%d,%d,%d,%s,%.2f\n", seed, number, static_cast<int>(out.kind),
               given.body.c_str(), given.paths.size(), 1e3 * out.off.rms_m, out.off.rotation_rad / kDegree,
               1e3 * out.bound.rms_m, out.bound.rotation_rad / kDegree, out.wrong ? 1 : 0, out.good ? 1 : 0,
               out.trusted ? 1 : 0, out.codes.c_str(), out.time_s);
  if (std::fclose(file) != 0) throw asperity::Error("cannot write " + name);
}

asperity::ScanPoints points_of(const bench::RegistrationCase& given) {
  asperity::ScanPoints scans;
  for (const asperity::MeasuredPath& path : given.paths) {
    asperity::PathPoints& points = scans.points.emplace_back();
    points.path = path;
    for (std::size_t i = 0; i < path.p_world_m.size(); ++i) points.sample.push_back(static_cast<double>(i));
  }
  return scans;
}

Outcome run_case(const bench::RegistrationCase& given, const asperity::ScanPoints& scans, int number, bool each) {
  const auto begin = std::chrono::steady_clock::now();
  const asperity::LocatedScans located = asperity::locate_scans(scans, *given.surface, given.guess, given.config);
  const asperity::RegistrationResult& result = located.placements.front().registration;
  Outcome out;
  out.time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  out.kind = given.kind;
  out.done = true;
  const asperity::Verdicts verdicts = asperity::judge_pose(result, given.guess.has_value());
  out.trusted = asperity::is_trustworthy(verdicts);
  bench::PoseDifference& off = out.off;
  bench::PoseDifference& bound = out.bound;
  if (given.T_mesh_world) {
    std::vector<Eigen::Vector3d> p_m;
    for (const asperity::MeasuredPath& path : given.paths) {
      p_m.insert(p_m.end(), path.p_world_m.begin(), path.p_world_m.end());
    }
    // On a mesh of another size the path's middle is where it is, in proportion.
    Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : p_m) middle_m += p / static_cast<double>(p_m.size());
    asperity::Pose scaled = result.T_mesh_world;
    scaled.translation_m = (scaled * middle_m) / given.scale - scaled.rotation * middle_m;
    off = bench::difference_modulo(given.symmetry, scaled, *given.T_mesh_world, p_m, kWrong_m, kWrong_rad);
    bound = bench::pose_bound(given.lines, given.errors, given.symmetry);
  }
  out.wrong = off.rms_m > kWrong_m || off.rotation_rad > kWrong_rad || given.kind == bench::CaseClass::kVeryWrongScale;
  out.good = given.T_mesh_world && given.scale == 1.0 && off.rms_m <= kGood_m && off.rotation_rad <= kGood_rad &&
             bound.rms_m < kBound_m && bound.rotation_rad < kBound_rad;
  for (const asperity::Verdict& verdict : verdicts) out.codes += (out.codes.empty() ? "" : " ") + verdict.code;
  if (!each) return out;
  double length_m = 0.0;
  for (const auto& line : given.lines) length_m += bench::kPathSpacing_m * static_cast<double>(line.p_m.size());
  std::fprintf(
      stderr,
      "%4d %-38s %-14s %zu paths in %zu placements %3.0f mm drift %.2f relief %.3f | off %7.3f mm %7.2f° bound %.3f mm "
      "%.2f° rms "
      "%.3f drift ratio %.2f e^%.2f odds %.1e sigma %.2f mm %.2f° scale %.3f: %.3f ± %.3f  gain %.1f chance %.2g "
      "mirror "
      "%.1f | %s%s%s | %s "
      "| %.2f s\n",
      number, std::string(bench::kCaseClassNames.at(static_cast<std::size_t>(given.kind))).c_str(), given.body.c_str(),
      given.lines.size(), located.placements.size(), 1e3 * length_m, 1e3 * given.errors.slow_m,
      1e3 * given.errors.relief_m, 1e3 * off.rms_m, off.rotation_rad / kDegree, 1e3 * bound.rms_m,
      bound.rotation_rad / kDegree, 1e3 * result.rms_m, result.rivals.slow_ratio, result.rivals.slow_ratio_sigma,
      result.rivals.odds, 1e3 * result.rivals.sigma_m, result.rivals.sigma_rad / kDegree, 1.0 / given.scale,
      result.rivals.scale.ratio, result.rivals.scale.ratio * result.rivals.scale.sigma, result.rivals.scale.gain,
      result.rivals.chance, result.rivals.mirror_log_odds, out.wrong ? "WRONG" : "", out.good ? "good" : "",
      out.wrong && out.trusted ? " BUT VALID" : (out.good && !out.trusted ? " BUT INVALID" : ""), out.codes.c_str(),
      out.time_s);
  return out;
}

void print_row(const std::string& name, const std::vector<const Outcome*>& outcomes) {
  const auto count = [&](auto is) {
    return std::count_if(outcomes.begin(), outcomes.end(), [&](auto* o) { return is(*o); });
  };
  std::vector<double> times_s;
  for (const Outcome* outcome : outcomes) times_s.push_back(outcome->time_s);
  std::sort(times_s.begin(), times_s.end());
  std::printf("| %s | %zu | %td | %td | %td | %td |", name.c_str(), outcomes.size(),
              count([](auto& o) { return o.wrong; }), count([](auto& o) { return o.wrong && o.trusted; }),
              count([](auto& o) { return o.good; }), count([](auto& o) { return o.good && o.trusted; }));
  std::printf(" %td |\n", count([](auto& o) { return o.trusted; }));
  std::fprintf(stderr, "%s: %.2f s in the median, %.2f s at most\n", name.c_str(), times_s[times_s.size() / 2],
               times_s.back());
}

void run(const Options& options) {
  const auto seed = static_cast<std::uint64_t>(options.seed);
  const bench::BodyPool pool = bench::make_bodies(options.meshes, seed);
  std::vector<Outcome> outcomes(static_cast<std::size_t>(options.cases));
  std::atomic<int> next = 0;
  std::exception_ptr failed;
  std::atomic<bool> stop = false;
  const auto work = [&] {
    for (int i = next++; i < options.cases && !stop; i = next++) {
      try {
        const bench::RegistrationCase drawn =
            bench::draw_case(pool, seed, static_cast<std::uint64_t>(options.first + i));
        if (options.only >= 0 && static_cast<int>(drawn.kind) != options.only) continue;
        Outcome& outcome = outcomes[static_cast<std::size_t>(i)];
        outcome = run_case(drawn, points_of(drawn), options.first + i, options.each);
        if (!options.csv.empty()) append_row(options.csv, options.seed, options.first + i, drawn, outcome);
      } catch (...) {
        if (!stop.exchange(true)) failed = std::current_exception();
      }
    }
  };
  std::vector<std::thread> workers;
  for (int i = 1; i < options.jobs; ++i) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();
  if (failed) std::rethrow_exception(failed);

  std::printf(
      "| case | cases | wrong | of them valid | good | of them valid | valid in all |\n"
      "|---|---|---|---|---|---|---|\n");
  std::vector<const Outcome*> all;
  for (std::size_t kind = 0; kind < bench::kCaseClassNames.size(); ++kind) {
    std::vector<const Outcome*> of_kind;
    for (const Outcome& outcome : outcomes) {
      if (outcome.done && outcome.kind == static_cast<bench::CaseClass>(kind)) of_kind.push_back(&outcome);
    }
    if (of_kind.empty()) continue;
    print_row(std::string(bench::kCaseClassNames[kind]), of_kind);
    all.insert(all.end(), of_kind.begin(), of_kind.end());
  }
  print_row("all", all);
  if (options.whole == 0) return;
  std::vector<Outcome> whole;
  for (int i = 0; i < options.whole; ++i) {
    const bench::WholeCase drawn = bench::simulate_case(pool, seed, static_cast<std::uint64_t>(i));
    whole.push_back(run_case(drawn.as, drawn.scans, i, options.each));
  }
  std::vector<const Outcome*> of_whole;
  for (const Outcome& outcome : whole) of_whole.push_back(&outcome);
  print_row("from whole recordings", of_whole);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    bench::read_options(
        argc, argv,
        {{"--cases", [&](auto value) { options.cases = static_cast<int>(bench::number_within(value, 1, 100000)); }},
         {"--first", [&](auto value) { options.first = static_cast<int>(bench::number_within(value, 0, 100000)); }},
         {"--whole", [&](auto value) { options.whole = static_cast<int>(bench::number_within(value, 0, 1000)); }},
         {"--seed", [&](auto value) { options.seed = static_cast<int>(bench::number_within(value, 0, 1e6)); }},
         {"--jobs", [&](auto value) { options.jobs = static_cast<int>(bench::number_within(value, 1, 64)); }},
         {"--only", [&](auto value) { options.only = static_cast<int>(bench::number_within(value, 0, 10)); }},
         {"--csv", [&](auto value) { options.csv = value; }},
         {"--mesh", [&](auto value) { options.meshes = bench::split_list(value); }},
         {"--each", [&](auto value) { options.each = bench::is_first(value, "yes", "no"); }}});
    run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "registration_green: %s\n", error.what());
    return 1;
  }
  return 0;
}
