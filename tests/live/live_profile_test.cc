#include "asperity/live/live_profile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/live/replay_arrivals.h"
#include "asperity/pipeline/measure_accuracy.h"
#include "asperity/simulation/simulate_recording.h"

namespace asperity {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Recording& sine_scan() {
  static const Recording recording = [] {
    SimulationConfig config = make_simulation_config("sine", "open");
    config.seed = 1;
    return simulate_recording(config);
  }();
  return recording;
}

struct Played {
  std::vector<LiveTip> tips;
  std::vector<LivePoint> points;
  LiveEstimate last;
  double highest_age_s = 0.0;
};

// What happens to a row or pose on its way; false: it is lost.
using SpoilRow = std::function<bool(ProbeSample&, LiveProfile&)>;
using SpoilPose = std::function<bool(TrackerSample&, LiveProfile&)>;

Played play(const Recording& recording, const SpoilRow& spoil_row = {}, const SpoilPose& spoil_pose = {},
            const LiveProfileConfig& config = {}, const ArrivalConfig& delays = {}) {
  Played out;
  LiveProfile live(recording.calibration, recording.info, config);
  std::size_t count = 0;
  for (const ScanArrival& arrival : list_arrivals(recording, delays)) {
    if (arrival.kind == ScanArrival::Kind::kRow) {
      ProbeSample row = probe_sample(recording.probe, arrival.index);
      if (!spoil_row || spoil_row(row, live)) live.push(row);
    } else {
      TrackerSample pose = tracker_sample(recording.tracker, arrival.index);
      if (!spoil_pose || spoil_pose(pose, live)) live.push(pose);
    }
    if (++count % 50 != 0) continue;
    LiveEstimate news = live.estimate();
    if (std::isfinite(news.age_s)) out.highest_age_s = std::max(out.highest_age_s, news.age_s);
    out.tips.insert(out.tips.end(), news.tips.begin(), news.tips.end());
    out.points.insert(out.points.end(), news.points.begin(), news.points.end());
    out.last = std::move(news);
  }
  return out;
}

double after_start_s(const Recording& recording, std::int64_t t_ns) {
  return 1e-9 * static_cast<double>(t_ns - recording.probe.t_ns.front());
}

Accuracy accuracy_of(const Recording& recording, const Played& played) {
  TipMotion motion;
  Profile profile;
  for (const LiveTip& tip : played.tips) {
    motion.t_ns.push_back(tip.t_ns);
    motion.p_world_tip_m.push_back(tip.p_world_tip_m);
  }
  for (const LivePoint& point : played.points) {
    profile.s_m.push_back(point.s_m);
    profile.height_m.push_back(point.height_m);
  }
  return measure_accuracy(recording, motion, profile, {});
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void expect_same(const Played& a, const Played& b) {
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    ASSERT_TRUE(same_bits(a.points[i].height_m, b.points[i].height_m)) << i;
    ASSERT_TRUE(same_bits(a.points[i].texture_m, b.points[i].texture_m)) << i;
  }
}

TEST(LiveProfile, FollowsTheTruthWithin200Milliseconds) {
  const Played played = play(sine_scan());
  const Accuracy accuracy = accuracy_of(sine_scan(), played);
  // The batch reaches 0.997; the live one lacks the poses that are still to come.
  EXPECT_GT(accuracy.profile->correlation, 0.95);
  EXPECT_NEAR(accuracy.profile->gain, 1.0, 0.06);
  EXPECT_NEAR(accuracy.profile->length_error_percent, 0.0, 3.0);
  EXPECT_LT(accuracy.position_rms_m, accuracy.tracker_rms_m) << "better than the tracker alone";
  EXPECT_LT(played.highest_age_s, 0.2);
  EXPECT_TRUE(played.last.base.known);
  EXPECT_EQ(played.last.counts.restarts, 0u);
  EXPECT_EQ(played.last.waiting, "");
}

// A slow machine tracks late: the profile waits for the poses, and is as good as with a fast one.
TEST(LiveProfile, PosesThatComeLateDelayItButDoNotSpoilIt) {
  for (const double late_s : {0.1, 0.2, 0.25}) {
    const Played played = play(sine_scan(), {}, {}, {}, {0.0, late_s});
    const Accuracy accuracy = accuracy_of(sine_scan(), played);
    EXPECT_GT(accuracy.profile->correlation, 0.95) << late_s;
    EXPECT_NEAR(accuracy.profile->gain, 1.0, 0.06) << late_s;
    // How late the poses come (the stamp's latency, 12 ms, and its faults with it), 80 ms and a hop.
    EXPECT_LT(played.highest_age_s, late_s + 0.015 + 0.08 + 0.03) << late_s;
  }
  // But no longer than the longest lag (and a hop).
  LiveProfileConfig config;
  config.tip.longest_lag_s = 0.2;
  const Played played = play(sine_scan(), {}, {}, config, {0.0, 0.25});
  EXPECT_LT(played.highest_age_s, 0.2 + 0.03);
}

double greatest_step_m(const Played& played) {
  double before_m = kNan, out_m = 0.0;
  for (const LivePoint& point : played.points) {
    if (std::isfinite(before_m) && std::isfinite(point.height_m))
      out_m = std::max(out_m, std::abs(point.height_m - before_m));
    before_m = point.height_m;
  }
  return out_m;
}

// The lag grows and shrinks: what was corrected meanwhile goes in slowly, not as a step.
TEST(LiveProfile, ALagThatChangesMakesNoStep) {
  const Recording& scan = sine_scan();
  const auto played_with = [&](std::int64_t later_ns) {
    std::vector<ScanArrival> arrivals = list_arrivals(scan, {0.0, 0.025});
    for (ScanArrival& arrival : arrivals) {
      const double t_s = after_start_s(scan, arrival.arrival_ns);
      if (arrival.kind == ScanArrival::Kind::kPose && t_s > 1.5 && t_s < 2.3) arrival.arrival_ns += later_ns;
    }
    std::stable_sort(arrivals.begin(), arrivals.end(),
                     [](const ScanArrival& a, const ScanArrival& b) { return a.arrival_ns < b.arrival_ns; });
    LiveProfile live(scan.calibration, scan.info, {});
    for (const ScanArrival& arrival : arrivals) {
      arrival.kind == ScanArrival::Kind::kRow ? live.push(probe_sample(scan.probe, arrival.index))
                                              : live.push(tracker_sample(scan.tracker, arrival.index));
    }
    Played out;
    out.last = live.estimate();
    out.points = out.last.points;
    out.tips = out.last.tips;
    return out;
  };
  const Played even = played_with(0), uneven = played_with(225'000'000);
  EXPECT_GT(accuracy_of(scan, uneven).profile->correlation, 0.95);
  EXPECT_LT(greatest_step_m(uneven), greatest_step_m(even) + 20e-6) << "points are 25 um apart";
}

// Holes at the stroke's begin, longer and deeper than the way so far: no base shape is to be made of them.
TEST(LiveProfile, HolesAtTheBeginAreNotTakenForTheBase) {
  for (const std::int64_t seed : {1, 2, 3}) {
    SimulationConfig config = make_simulation_config("protoboard", "open");
    config.seed = seed;
    const Recording scan = simulate_recording(config);
    const Played played = play(scan);
    EXPECT_GT(accuracy_of(scan, played).profile->correlation, 0.9) << seed;  // the batch reaches 0.98
    for (const LivePoint& point : played.points) {
      if (point.s_m > 0.02 || !std::isfinite(point.height_m)) continue;
      // The holes are 1.5 mm deep; the plane across the probe's axis is tilted by a few degrees.
      ASSERT_LT(std::abs(point.height_m), 4e-3) << seed << ": " << point.s_m;
    }
  }
}

TEST(LiveProfile, PointsAreAnEvenSpacingApartAndNeverChange) {
  const Played played = play(sine_scan());
  ASSERT_GT(played.points.size(), 1000u);
  for (std::size_t i = 1; i < played.points.size(); ++i) {
    EXPECT_NEAR(played.points[i].s_m - played.points[i - 1].s_m, 0.025e-3, 1e-9);
    EXPECT_GE(played.points[i].t_ns, played.points[i - 1].t_ns);
  }
  for (std::size_t i = 1; i < played.tips.size(); ++i) EXPECT_GT(played.tips[i].t_ns, played.tips[i - 1].t_ns);
}

TEST(LiveProfile, RepeatedDisorderedAndWildInputChangesNothing) {
  const Played clean = play(sine_scan());
  std::size_t k = 0;
  const Played spoilt = play(
      sine_scan(),
      [&](ProbeSample& row, LiveProfile& live) {
        ProbeSample wild = row;
        if (++k % 7 == 0) wild.accel_counts.x() = kNan, live.push(wild);
        if (k % 11 == 0) wild = row, wild.accel_counts.y() = 1e300, live.push(wild);
        if (k % 13 == 0 && k > 100) wild = row, wild.t_ns -= 5'000'000, live.push(wild);
        if (k % 17 == 0) live.push(row), live.push(row);
        if (k == 1000) wild = row, wild.t_ns = std::numeric_limits<std::int64_t>::max(), live.push(wild);
        return k % 17 != 0;
      },
      [&](TrackerSample& pose, LiveProfile& live) {
        TrackerSample wild = pose;
        wild.T_world_marker.translation_m.z() = kNan;
        live.push(wild);
        wild = pose;
        wild.T_world_marker.rotation.coeffs().setZero();
        live.push(wild);
        wild = pose;
        wild.t_ns += 20'000'000'000;
        live.push(wild);
        live.push(pose);
        return true;  // once more
      });
  EXPECT_GT(spoilt.last.counts.rows_refused, 1000u);
  EXPECT_GT(spoilt.last.counts.poses_refused, 1000u);
  expect_same(clean, spoilt);
}

TEST(LiveProfile, GoesOnThroughLostPosesAndLostRows) {
  const Played played = play(
      sine_scan(),
      [](ProbeSample& row, LiveProfile&) {
        const double t_s = after_start_s(sine_scan(), row.t_ns);
        return !(t_s > 2.9 && t_s < 2.95);
      },
      [](TrackerSample& pose, LiveProfile&) {
        const double t_s = after_start_s(sine_scan(), pose.t_ns);
        return !(t_s > 2.0 && t_s < 2.4);
      });
  const Accuracy accuracy = accuracy_of(sine_scan(), played);
  EXPECT_GT(accuracy.profile->correlation, 0.85);
  EXPECT_LT(played.highest_age_s, 0.2 + 0.05) << "the hole in the rows is itself 50 ms";
  EXPECT_EQ(played.last.counts.restarts, 0u);
  EXPECT_NEAR(static_cast<double>(played.last.counts.rows_lost), 200.0, 3.0);
}

TEST(LiveProfile, BeginsAnewAfterALongHoleWithAGapInTheProfile) {
  const Played played = play(sine_scan(), [](ProbeSample& row, LiveProfile&) {
    const double t_s = after_start_s(sine_scan(), row.t_ns);
    return !(t_s > 2.0 && t_s < 2.6);
  });
  EXPECT_EQ(played.last.counts.restarts, 1u);
  EXPECT_TRUE(std::isfinite(played.points.back().height_m));
  EXPECT_LT(std::abs(played.points.back().height_m), 2e-3);
}

TEST(LiveProfile, WithoutAMarkerNothingIsShownAndThenItComesBack) {
  const Played played = play(sine_scan(), {}, [](TrackerSample& pose, LiveProfile&) {
    const double t_s = after_start_s(sine_scan(), pose.t_ns);
    return !(t_s > 1.2 && t_s < 2.8);
  });
  EXPECT_EQ(played.last.counts.restarts, 1u);
  for (const LiveTip& tip : played.tips) {
    const double t_s = after_start_s(sine_scan(), tip.t_ns);
    if (t_s > 2.45 && t_s < 2.75) ADD_FAILURE() << "a tip at " << t_s << " s";
  }
  EXPECT_GT(after_start_s(sine_scan(), played.tips.back().t_ns), 3.5);
}

TEST(LiveProfile, ALiftedTipGivesAGap) {
  const ForceCalibration& force = sine_scan().calibration.force;
  const Played played = play(sine_scan(), [&](ProbeSample& row, LiveProfile&) {
    const double t_s = after_start_s(sine_scan(), row.t_ns);
    if (t_s > 2.0 && t_s < 2.3 && std::isfinite(row.force_counts)) {
      row.force_counts = -force.offset_newton / force.newton_per_count;
    }
    return true;
  });
  int inside = 0;
  for (const LivePoint& point : played.points) {
    const double t_s = after_start_s(sine_scan(), point.t_ns);
    if (t_s > 2.01 && t_s < 2.28 && std::isfinite(point.height_m)) ++inside;
  }
  EXPECT_EQ(inside, 0);
  for (const LiveTip& tip : played.tips) {
    const double t_s = after_start_s(sine_scan(), tip.t_ns);
    if (t_s > 2.01 && t_s < 2.28) {
      EXPECT_FALSE(tip.contact) << t_s;
    }
  }
}

TEST(LiveProfile, RestartBeginsTheProfileAtZero) {
  bool done = false;
  double furthest_m = 0.0;
  const Played played = play(sine_scan(), [&](ProbeSample& row, LiveProfile& live) {
    if (!done && after_start_s(sine_scan(), row.t_ns) > 2.5) {
      done = true;
      live.restart();
    }
    return true;
  });
  bool again = false;
  for (std::size_t i = 1; i < played.points.size(); ++i) {
    if (played.points[i].s_m < played.points[i - 1].s_m) {
      again = true;
      furthest_m = played.points[i - 1].s_m;
      EXPECT_LT(played.points[i].s_m, 0.2e-3);
    }
  }
  EXPECT_TRUE(again);
  EXPECT_GT(furthest_m, 5e-3);
}

TEST(LiveProfile, SettingsChangeWhileScanning) {
  bool done = false;
  const Played played = play(sine_scan(), [&](ProbeSample& row, LiveProfile& live) {
    if (!done && after_start_s(sine_scan(), row.t_ns) > 2.5) {
      done = true;
      LiveProfileConfig config = live.config();
      config.profile.cutoff_cycles_per_mm = 0.4;
      live.configure(config);
    }
    return true;
  });
  EXPECT_TRUE(done);
  EXPECT_GT(played.points.back().s_m, 20e-3) << "the arc length goes on";
}

TEST(ListArrivals, PosesComeAfterTheRowsOfTheirTime) {
  const std::vector<ScanArrival> arrivals = list_arrivals(sine_scan(), {0.0, 0.01});
  ASSERT_EQ(arrivals.size(), sine_scan().probe.size() + sine_scan().tracker.size());
  EXPECT_TRUE(std::is_sorted(arrivals.begin(), arrivals.end(),
                             [](const ScanArrival& a, const ScanArrival& b) { return a.arrival_ns < b.arrival_ns; }));
  const auto pose = std::find_if(arrivals.begin(), arrivals.end(),
                                 [](const ScanArrival& a) { return a.kind == ScanArrival::Kind::kPose; });
  EXPECT_EQ(pose->arrival_ns, sine_scan().tracker.t_ns[pose->index] + 10'000'000);
}

}  // namespace
}  // namespace asperity
