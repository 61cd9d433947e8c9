#include "asperity/verdict/judge_scan.h"

#include <gmock/gmock.h>

#include <functional>

namespace asperity {
namespace {

using testing::HasSubstr;

// A scan of which nothing speaks against anything.
ScanEvidence good() {
  ScanEvidence e;
  e.force_ratio = 1.01;
  e.force_difference_share = 0.02;
  e.clipped_force_ratio = 0.97;
  e.departure_m = 0.7e-3;
  e.departure_ratio = 1.0;
  e.accel_bias_mps2 = 0.1;
  e.latency_s = 0.02;
  e.latency_beyond_prior_s = 1e-3;
  e.latency_beyond_prior_sigma_s = 2e-3;
  e.tracker_scale_error = 0.01;
  e.tracker_scale_error_sigma = 0.02;
  e.tracker_axes_chi2 = 9.0;
  e.accel_axes_chi2 = 9.0;
  e.gyro_axes_chi2 = 9.0;
  e.latency_change_s = 3e-3;
  e.latency_change_sigma_s = 2e-3;
  e.accel_motion_share = 0.01;
  e.tip_radius_m = 0.32e-3;
  e.tracker_noise_ratio = 1.1;
  e.poses_used = 400;
  e.poses_outlying = 3;
  e.clipped_share = 0.0;
  e.rows_kept = 6000;
  e.recorded_s = 10.0;
  e.used_s = 9.9;
  e.samples = 5000;
  e.contact_s = 9.0;
  e.covered = 0.98;
  e.length_m = 0.0801;
  e.length_stderr_m = 0.2e-3;
  e.tracker_length_m = 0.0803;
  e.tracker_length_stderr_m = 0.6e-3;
  e.texture_rms_m = 50e-6;
  e.noise_rms_m = 5e-6;
  e.snr = 99.0;
  e.at_most_m = 50e-6;
  return e;
}

std::vector<std::string> codes(const ScanEvidence& evidence) {
  std::vector<std::string> out;
  for (const Verdict& verdict : judge_scan(evidence)) out.push_back(verdict.code);
  return out;
}

TEST(JudgeScan, NormalsFromWhichTheProbeLeansAsNoHandHoldsItAreDoubtful) {
  ScanEvidence e = good();
  e.probe_lean_deg = 30.0;
  EXPECT_TRUE(is_trustworthy(judge_scan(e)));
  e.probe_lean_deg = 63.0;
  const Verdicts verdicts = judge_scan(e);
  EXPECT_FALSE(is_trustworthy(verdicts));
  EXPECT_EQ(verdicts.front().code, "normals_doubtful");
  EXPECT_THAT(verdicts.front().message, HasSubstr("63°"));
}

TEST(JudgeScan, HasNothingAgainstAGoodScan) { EXPECT_THAT(codes(good()), testing::IsEmpty()); }

// Restored peaks differ from the tracker's motion by themselves, as in scan 1000068 of the bench (r = 0.93); wrong axes
// differ much more, or the tracker's own axes do.
TEST(JudgeScan, CutPeaksAreNoWrongAxes) {
  ScanEvidence e = good();
  e.clipped_share = 0.019;
  e.accel_axes_chi2 = 38.0;
  EXPECT_EQ(codes(e), std::vector<std::string>{"peaks_clipped"});
  e.clipped_share = 0.0;
  EXPECT_EQ(codes(e), std::vector<std::string>{"motions_disagree"});
  e.clipped_share = 0.019;
  e.accel_axes_chi2 = 400.0;
  EXPECT_EQ(codes(e), std::vector<std::string>{"motions_disagree"});
  e.accel_axes_chi2 = 38.0;
  e.accel_motion_share = 0.5;
  EXPECT_EQ(codes(e), std::vector<std::string>{"motions_disagree"});
  e.accel_motion_share = 0.01;
  e.tracker_axes_chi2 = 38.0;
  EXPECT_EQ(codes(e), std::vector<std::string>{"motions_disagree"});
}

// As in scan 431000050 of the second bench, on glass at r = 0.32.
TEST(JudgeScan, ATextureThatStandsOutInATypicalStretchMustDoSoOverThePath) {
  ScanEvidence e = good();
  e.snr = 2.11;
  e.expected_correlation = 0.795;
  EXPECT_EQ(codes(e), std::vector<std::string>{"below_noise"});
  e.expected_correlation = 0.82;  // √(2/3) = 0.816
  EXPECT_EQ(codes(e), std::vector<std::string>{"noisy_texture"});
  e.expected_correlation = ScanEvidence::kUnknown;
  EXPECT_EQ(codes(e), std::vector<std::string>{"noisy_texture"});
  // The length's error takes its share of the correlation, which is no noise.
  e.expected_correlation = 0.795;
  e.stretch_correlation = 0.96;
  EXPECT_EQ(codes(e), std::vector<std::string>{"noisy_texture"});
}

TEST(JudgeScan, AForceAtTheEndOfItsRangeLimits) {
  ScanEvidence e = good();
  e.force_limited_share = 0.03;
  e.force_limit_N = 1.8;
  const Verdicts verdicts = judge_scan(e);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].code, "force_clipped");
  EXPECT_EQ(verdicts[0].severity, Severity::kLimited);
  EXPECT_THAT(verdicts[0].message, HasSubstr("3 % of the force's readings are at its highest value, 1.8 N"));
}

// Nothing is concluded against a scan from what is unknown, but heights whose noise is unknown are not valid.
TEST(JudgeScan, HeightsOfUnknownNoiseAreNotValid) {
  EXPECT_THAT(codes(ScanEvidence()), testing::ElementsAre("error_unknown"));
  ScanEvidence e = good();
  e.snr = ScanEvidence::kUnknown;
  EXPECT_THAT(codes(e), testing::ElementsAre("error_unknown"));
  EXPECT_FALSE(is_trustworthy(judge_scan(e)));
}

struct Case {
  std::string code;
  std::string message;  // a part of it
  std::function<void(ScanEvidence&)> spoil;
};

// One fault at a time gives its own code and no other.
TEST(JudgeScan, NamesEachFaultByItsCode) {
  const std::vector<Case> cases{
      {"uncalibrated", "without a calibration", [](ScanEvidence& e) { e.calibrated = false; }},
      {"wrong_unit", "0.102 times", [](ScanEvidence& e) { e.force_ratio = 0.102; }},
      {"wrong_unit", "0.09 times", [](ScanEvidence& e) { e.clipped_force_ratio = 0.09; }},
      {"wrong_frame", "by 200 %", [](ScanEvidence& e) { e.force_difference_share = 2.0; }},
      {"wrong_frame", "bias would be 20 m/s²", [](ScanEvidence& e) { e.accel_bias_mps2 = 19.6; }},
      {"latency_off", "by 22 ± 2 ms from the calibrated latency, 11 standard",
       [](ScanEvidence& e) { e.latency_beyond_prior_s = 22e-3; }},
      {"latency_off", "by -22 ± 2 ms", [](ScanEvidence& e) { e.latency_beyond_prior_s = -22e-3; }},
      {"scale_disagrees", "0.500 ± 0.020 times", [](ScanEvidence& e) { e.tracker_scale_error = -0.5; }},
      {"scale_doubtful", "1.060 ± 0.020 times", [](ScanEvidence& e) { e.tracker_scale_error = 0.06; }},
      {"motions_disagree", "χ² = 120", [](ScanEvidence& e) { e.tracker_axes_chi2 = 120.0; }},
      {"motions_disagree", "χ² = 50", [](ScanEvidence& e) { e.accel_axes_chi2 = 50.0; }},
      {"rotations_disagree", "χ² = 400", [](ScanEvidence& e) { e.gyro_axes_chi2 = 400.0; }},
      {"clocks_drift", "departs from the probe's by -80 ± 2 ms, 36 standard",
       [](ScanEvidence& e) { e.latency_change_s = -80e-3; }},
      {"axes_unseen", "better (e^19 : 1)", [](ScanEvidence& e) { e.other_axes_log_ratio = 19.0; }},
      {"axes_unseen", "nearly as well", [](ScanEvidence& e) { e.other_axes_log_ratio = -3.0; }},
      {"motions_disagree", "97 %", [](ScanEvidence& e) { e.accel_motion_share = 0.97; }},
      {"motions_disagree", "to ± 90 % only", [](ScanEvidence& e) { e.tracker_scale_error_sigma = 0.9; }},
      {"not_moved", "0.2 mm only", [](ScanEvidence& e) { e.length_m = 0.2e-3; }},
      {"nothing_touched", "reads no contact", [](ScanEvidence& e) { e.reads_no_contact = true; }},
      {"tracker_noise", "25 times", [](ScanEvidence& e) { e.tracker_noise_ratio = 25.0; }},
      {"poses_outlying", "150 of 550", [](ScanEvidence& e) { e.poses_outlying = 150; }},
      {"poses_disagree", "2.1 mm from the tracker's poses, 3 times",
       [](ScanEvidence& e) {
         e.departure_m = 2.1e-3;
         e.departure_ratio = 3.0;
         e.poses_outlying = 150;  // the same fault once
       }},
      {"tracker_repeats", "repeats", [](ScanEvidence& e) { e.repeated_share = 0.6; }},
      {"clipped", "60 %", [](ScanEvidence& e) { e.clipped_share = 0.6; }},
      {"clipped", "reduced its mean by 16 %",
       [](ScanEvidence& e) {
         e.clipped_force_ratio = 0.84;
         e.accel_bias_mps2 = 4.2;  // by the same cause
       }},
      {"accel_filtered",
       "or its stated noise is too large: above 512 Hz it has 0.3 % of the power of that noise: waves shorter than "
       "0.049 mm",
       [](ScanEvidence& e) {
         e.accel_floor_ratio = 0.003;
         e.accel_rounding_ratio = 1.1;
         e.accel_quiet_from_Hz = 512.0;
         e.mean_speed_mps = 0.025;
       }},
      {"changed_bytes", "17 rows", [](ScanEvidence& e) { e.rows_changed = 17; }},
      {"rows_lost", "2000 of 8000", [](ScanEvidence& e) { e.rows_dropped = 2000; }},
      {"little_overlap", "1.5 s of the 10.0 s", [](ScanEvidence& e) { e.used_s = 1.5; }},
      {"tracker_gap", "0.80 s", [](ScanEvidence& e) { e.tracker_gap_s = 0.8; }},
      {"object_unseen", "in 49 % of the scan", [](ScanEvidence& e) { e.object_seen_share = 0.499; }},
      {"object_hidden", "in 94 % of the scan; the rest", [](ScanEvidence& e) { e.object_seen_share = 0.949; }},
      {"object_moved", "up to 12.3 mm and 30°",
       [](ScanEvidence& e) {
         e.object_seen_share = 0.97;
         e.object_moved_m = 12.3e-3;
         e.object_turned_rad = 0.5236;
       }},
      {"spikes", "600 of 5000", [](ScanEvidence& e) { e.samples_rejected = 600; }},
      {"no_profile", "the profile is missing: too short", [](ScanEvidence& e) { e.no_profile = "too short"; }},
      {"nothing_touched", "did not touch a surface", [](ScanEvidence& e) { e.contact_s = 0.0; }},
      {"nothing_touched", "only 60 %",
       [](ScanEvidence& e) {
         e.has_force = false;
         e.covered = 0.6;
         e.length_m = 13.36;
       }},
      {"below_noise", "at most 92 µm RMS in 52 µm",
       [](ScanEvidence& e) {
         e.snr = 1.4;
         e.noise_rms_m = 52e-6;
         e.at_most_m = 92e-6;
       }},
      {"below_noise", "at most 92 µm RMS",
       [](ScanEvidence& e) {
         e.snr = 1.4;
         e.expected_correlation = 0.89;
         e.at_most_m = 92e-6;
       }},
      {"below_noise", "at most 92 µm RMS",
       [](ScanEvidence& e) {
         e.snr = 0.0;  // of a typical stretch
         e.expected_correlation = 0.95;
         e.at_most_m = 92e-6;
       }},
      {"noisy_texture", "50 µm RMS 19 µm",
       [](ScanEvidence& e) {
         e.snr = 1.4;
         e.expected_correlation = 0.91;
         e.noise_rms_m = 19e-6;
       }},
      {"below_noise", "at most 92 µm RMS",
       [](ScanEvidence& e) {
         e.snr = 0.0;
         e.pattern_found = true;
         e.expected_correlation = 0.81;  // below √(2/3)
         e.at_most_m = 92e-6;
       }},
      {"noisy_texture", "50 µm RMS 19 µm",
       [](ScanEvidence& e) {
         e.snr = 0.0;
         e.pattern_found = true;
         e.expected_correlation = 0.83;
         e.noise_rms_m = 19e-6;
       }},
      {"noisy_texture", "50 µm RMS 19 µm",
       [](ScanEvidence& e) {
         e.snr = 3.0;
         e.noise_rms_m = 19e-6;
       }},
      {"positions_uncertain",
       "by up to 0.61 mm (standard deviation) from their positions: the expected correlation with "
       "the surface is 0.72",
       [](ScanEvidence& e) {
         e.snr = 25.0;
         e.expected_correlation = 0.72;
         e.stretch_correlation = 0.735;
         e.end_place_sigma_m = 0.61e-3;
       }},
      {"positions_doubtful", "the expected correlation with the surface is 0.78",
       [](ScanEvidence& e) {
         e.snr = 25.0;
         e.expected_correlation = 0.78;
         e.stretch_correlation = 0.8;
       }},
      {"vibration",
       "a vibration of 60.02 Hz that is not of the surface is in the heights: 16 of the texture's 50 µm RMS",
       [](ScanEvidence& e) {
         e.vibration_Hz = 60.02;
         e.vibration_rms_m = 16e-6;
       }},
      {"may_be_hum", "50.1 times a second", [](ScanEvidence& e) { e.may_be_hum_Hz = 50.1; }},
      {"length_disagrees", "122.00 mm long, by the tracker's poses alone 80.30 ± 1.24 mm",
       [](ScanEvidence& e) { e.length_m = 0.122; }},
      {"error_unknown", "no error", [](ScanEvidence& e) { e.error_known = false; }},
      {"little_coverage", "12 %", [](ScanEvidence& e) { e.covered = 0.12; }},
      {"contact_unknown", "force never changes", [](ScanEvidence& e) { e.has_force = false; }},
      {"no_roughness", "roughness is missing: too short", [](ScanEvidence& e) { e.no_roughness = "too short"; }},
      {"no_texture", "the texture is missing: too short", [](ScanEvidence& e) { e.no_texture = "too short"; }},
  };
  for (const Case& one : cases) {
    ScanEvidence evidence = good();
    one.spoil(evidence);
    const Verdicts verdicts = judge_scan(evidence);
    ASSERT_EQ(verdicts.size(), 1U) << one.code;
    EXPECT_EQ(verdicts[0].code, one.code);
    EXPECT_THAT(verdicts[0].message, HasSubstr(one.message));
  }
}

// A pattern's line shows that there is a texture, not where it lies: at an SNR of 0 the length's error counts all the
// same.
TEST(JudgeScan, APatternWhosePositionsAreUncertainIsInvalid) {
  ScanEvidence evidence = good();
  evidence.snr = 0.0;
  evidence.pattern_found = true;
  evidence.stretch_correlation = 0.5;
  evidence.expected_correlation = 0.45;
  evidence.end_place_sigma_m = 0.61e-3;
  const Verdicts verdicts = judge_scan(evidence);
  ASSERT_FALSE(verdicts.empty());
  EXPECT_EQ(verdicts[0].code, "positions_uncertain");
  EXPECT_THAT(verdicts[0].message, HasSubstr("the expected correlation with the surface is 0.45"));
  EXPECT_FALSE(is_trustworthy(verdicts));
}

// Noise is not named as an error of the length, nor the other way about.
TEST(JudgeScan, TheLargerOfNoiseAndMisplacementIsNamed) {
  ScanEvidence evidence = good();
  evidence.snr = 25.0;
  evidence.stretch_correlation = 0.9;
  evidence.expected_correlation = 0.88;
  EXPECT_TRUE(judge_scan(evidence).empty());  // 0.9 · √(25/26) is above √(2/3)
  evidence.snr = 2.1;                         // 0.82 by the noise
  evidence.expected_correlation = 0.75;
  ASSERT_EQ(judge_scan(evidence).size(), 1U);
  EXPECT_EQ(judge_scan(evidence)[0].code, "noisy_texture");
  evidence.snr = 1.0;
  evidence.stretch_correlation = 0.7;
  evidence.expected_correlation = 0.6;
  ASSERT_EQ(judge_scan(evidence).size(), 1U);
  EXPECT_EQ(judge_scan(evidence)[0].code, "below_noise");
}

// A stated noise that holds the misfit of a calibration is no sign of a filter where there is noise beside rounding.
TEST(JudgeScan, AnAccelerometerQuieterThanStatedIsNotFiltered) {
  ScanEvidence evidence = good();
  evidence.accel_floor_ratio = 0.003;
  evidence.accel_rounding_ratio = 5.0;
  EXPECT_TRUE(judge_scan(evidence).empty());
  // Of readings that are no whole counts, rounding cannot be seen: only what no misfit explains is named.
  evidence.accel_rounding_ratio = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(judge_scan(evidence).empty());
  evidence.accel_floor_ratio = 0.0005;
  EXPECT_EQ(codes(evidence), std::vector<std::string>{"accel_filtered"});
}

// Weaker than a tenth of the texture's power it is in the noise, and that is all.
TEST(JudgeScan, AWeakVibrationIsNotNamed) {
  ScanEvidence evidence = good();
  evidence.vibration_Hz = 60.0;
  evidence.vibration_rms_m = 15e-6;
  EXPECT_TRUE(judge_scan(evidence).empty());
}

TEST(JudgeScan, OfAMotionAloneTheSurfaceIsNotJudged) {
  ScanEvidence evidence = good();
  evidence.measured = false;
  evidence.covered = 0.0;
  evidence.has_force = false;
  EXPECT_THAT(codes(evidence), testing::IsEmpty());
}

}  // namespace
}  // namespace asperity
