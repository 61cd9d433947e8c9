// The live profile beside the batch's and the truth: surface × probe × speed, medians over several seeds. Prints a
// table in Markdown: correlation and gain of live and batch with the truth in the band of docs/profile.md, of live with
// batch, error over sigma, how far the profile is behind the probe in data time, and processor time a row.
//
//   live_bench_speed [--seeds N] [--speeds 10,25,45] [--probes open,what] [--surfaces …] [--pose-delay-ms 5]
//                    [--set field=value]…
//   live_bench_speed --recordings FOLDER,… : these instead of simulated ones, beside the batch's profile

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/live/live_profile.h"
#include "asperity/live/replay_arrivals.h"
#include "asperity/pipeline/measure_accuracy.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/signal/statistics.h"
#include "asperity/simulation/simulate_recording.h"
#include "read_options.h"

namespace {

struct Options {
  int seeds = 3;
  double pose_delay_s = 0.005;
  std::vector<std::string> surfaces{"sine", "protoboard", "sandpaper", "cable_tie", "clay_pot"};
  std::vector<std::string> probes{"open", "what"};
  std::vector<std::string> speeds{"10", "25", "45"};
  std::vector<std::string> recordings;
  asperity::LiveProfileConfig config;
};

Options parse_options(int argc, char** argv) {
  Options out;
  const auto set = [&](std::string_view value) {
    const std::size_t equals = value.find('=');
    if (equals == std::string_view::npos) throw asperity::Error("no '='");
    asperity::set_field(asperity::list_fields("", out.config), value.substr(0, equals), value.substr(equals + 1));
  };
  bench::read_options(
      argc, argv,
      {{"--seeds", [&](auto value) { out.seeds = bench::seed_count(value); }},
       {"--pose-delay-ms", [&](auto value) { out.pose_delay_s = 1e-3 * bench::number_within(value, 0.0, 1e4); }},
       {"--surfaces", [&](auto value) { out.surfaces = bench::split_list(value); }},
       {"--probes", [&](auto value) { out.probes = bench::split_list(value); }},
       {"--speeds", [&](auto value) { out.speeds = bench::split_list(value); }},
       {"--recordings", [&](auto value) { out.recordings = bench::split_list(value); }},
       {"--set", set}});
  return out;
}

double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Run {
  asperity::TipMotion motion;
  asperity::Profile profile;
  double highest_age_s = 0.0;        // of the motion
  double highest_point_age_s = 0.0;  // of a point when it came, while the tip moved
  double processor_s = 0.0;
  double longest_push_s = 0.0;
  asperity::LiveEstimate last;
};

// Plays the recording as it would have arrived and asks for news every 10 ms of data time.
Run play(const asperity::Recording& recording, const Options& options) {
  Run out;
  asperity::LiveProfile live(recording.calibration, recording.info, options.config);
  std::int64_t next_ns = 0;
  std::int64_t last_point_ns = 0;
  for (const asperity::ScanArrival& arrival : asperity::list_arrivals(recording, {0.0, options.pose_delay_s})) {
    const double before_s = processor_s();
    if (arrival.kind == asperity::ScanArrival::Kind::kRow) {
      live.push(asperity::probe_sample(recording.probe, arrival.index));
    } else {
      live.push(asperity::tracker_sample(recording.tracker, arrival.index));
    }
    const double took_s = processor_s() - before_s;
    out.processor_s += took_s;
    out.longest_push_s = std::max(out.longest_push_s, took_s);
    if (arrival.arrival_ns < next_ns) continue;
    next_ns = arrival.arrival_ns + 10'000'000;
    out.last = live.estimate();
    const asperity::LiveEstimate& news = out.last;
    if (std::isfinite(news.age_s)) out.highest_age_s = std::max(out.highest_age_s, news.age_s);
    for (const asperity::LiveTip& tip : news.tips) {
      out.motion.t_ns.push_back(tip.t_ns);
      out.motion.p_world_tip_m.push_back(tip.p_world_tip_m);
      out.motion.cov_world_tip_m2.push_back(tip.sigma_m * tip.sigma_m * Eigen::Matrix3d::Identity());
    }
    for (const asperity::LivePoint& point : news.points) {
      out.profile.s_m.push_back(point.s_m);
      out.profile.height_m.push_back(point.height_m);
      out.profile.sigma_m.push_back(point.sigma_m);
      out.profile.texture_m.push_back(point.texture_m);
      const double age_s = 1e-9 * static_cast<double>(news.newest_row_ns - point.t_ns);
      // While the tip stands still a point waits for it: that is no delay of the estimate.
      const bool moving = point.t_ns - last_point_ns < 20'000'000;
      last_point_ns = point.t_ns;
      if (moving && point.speed_mps > 5e-3) out.highest_point_age_s = std::max(out.highest_point_age_s, age_s);
    }
  }
  return out;
}

struct Column {
  std::vector<double> live, live_gain, batch, batch_gain, to_batch, to_batch_gain, length, over_sigma, batch_sigma,
      position_mm, batch_mm, age_ms, point_ms, us_row, share, longest_ms, texture;
};

void run(const Options& options) {
  std::printf(
      "| surface | probe | mm/s | live r | gain | batch r | gain | live:batch r | gain | texture r | length, %% | "
      "position live, "
      "batch, mm | error/sigma live, batch | motion delay, ms | point delay, ms | us/row | share of time, %% | "
      "longest "
      "push, ms |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& probe : options.probes) {
    for (const auto& surface : options.surfaces) {
      for (const auto& speed : options.speeds) {
        Column c;
        for (int seed = 1; seed <= options.seeds; ++seed) {
          asperity::SimulationConfig config = asperity::make_simulation_config(surface, probe);
          config.seed = seed;
          config.hand.speed_mps = 1e-3 * asperity::parse_double(speed).value_or(25.0);
          const asperity::Recording recording = asperity::simulate_recording(config);
          asperity::ProcessConfig process;
          const asperity::ProcessResult batch = asperity::process_recording(recording, process);
          const Run live = play(recording, options);
          const auto& b = *batch.accuracy;
          const auto a = asperity::measure_accuracy(recording, live.motion, live.profile, process.comparison);
          asperity::ComparisonConfig comparison = process.comparison;
          comparison.high_cycles_per_mm = a.band_high_cycles_per_mm;
          const auto ab = asperity::compare_profiles(live.profile.s_m, live.profile.height_m, batch.profile.s_m,
                                                     batch.profile.height_m, comparison);
          const auto texture = asperity::compare_profiles(live.profile.s_m, live.profile.texture_m, batch.profile.s_m,
                                                          batch.profile.texture_m, comparison);
          c.live.push_back(a.profile->correlation);
          c.live_gain.push_back(a.profile->gain);
          c.length.push_back(a.profile->length_error_percent);
          c.batch.push_back(b.profile->correlation);
          c.batch_gain.push_back(b.profile->gain);
          c.to_batch.push_back(ab.correlation);
          c.to_batch_gain.push_back(ab.gain);
          c.texture.push_back(texture.correlation);
          c.over_sigma.push_back(a.position_error_over_sigma);
          c.batch_sigma.push_back(b.position_error_over_sigma);
          c.position_mm.push_back(1e3 * a.position_rms_m);
          c.batch_mm.push_back(1e3 * b.position_rms_m);
          c.age_ms.push_back(1e3 * live.highest_age_s);
          c.point_ms.push_back(1e3 * live.highest_point_age_s);
          c.us_row.push_back(1e6 * live.processor_s / static_cast<double>(recording.probe.size()));
          c.share.push_back(100.0 * live.processor_s /
                            (1e-9 * static_cast<double>(recording.probe.t_ns.back() - recording.probe.t_ns.front())));
          c.longest_ms.push_back(1e3 * live.longest_push_s);
        }
        const auto m = [](const std::vector<double>& x) { return asperity::median(x); };
        const auto most = [](const std::vector<double>& x) { return *std::max_element(x.begin(), x.end()); };
        std::printf(
            "| %s | %s | %s | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.3f | %.2f | %.3f, %.3f | %.2f, %.2f | %.0f | "
            "%.0f | "
            "%.1f | %.1f | %.1f |\n",
            surface.c_str(), probe.c_str(), speed.c_str(), m(c.live), m(c.live_gain), m(c.batch), m(c.batch_gain),
            m(c.to_batch), m(c.to_batch_gain), m(c.texture), m(c.length), m(c.position_mm), m(c.batch_mm),
            m(c.over_sigma), m(c.batch_sigma), most(c.age_ms), most(c.point_ms), m(c.us_row), m(c.share),
            most(c.longest_ms));
        std::fflush(stdout);
      }
    }
  }
}

// Recordings of a real or rendered tracker have no truth: live beside batch.
void run_recordings(const Options& options) {
  std::printf("| recording | live:batch r | gain | RMS of the difference, µm | motion delay, ms | point delay, ms |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const std::string& folder : options.recordings) {
    const asperity::Recording recording = asperity::read_recording(folder);
    const asperity::ProcessConfig process;
    const asperity::ProcessResult batch = asperity::process_recording(recording, process);
    const Run live = play(recording, options);
    const auto difference = asperity::compare_profiles(live.profile.s_m, live.profile.height_m, batch.profile.s_m,
                                                       batch.profile.height_m, process.comparison);
    std::printf("| %s | %.3f | %.3f | %.0f | %.0f | %.0f |\n", folder.c_str(), difference.correlation, difference.gain,
                difference.rms_um, 1e3 * live.highest_age_s, 1e3 * live.highest_point_age_s);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parse_options(argc, argv);
    options.recordings.empty() ? run(options) : run_recordings(options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "live_bench_speed: %s\n", error.what());
    return 1;
  }
}
