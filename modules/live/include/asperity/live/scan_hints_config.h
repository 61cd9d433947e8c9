#pragma once

namespace asperity {

// When a ScanAdvisor speaks. A hint goes again when its value is better than its limit by `hysteresis`.
struct ScanHintsConfig {
  double finest_wavelength_mm = 1.0;
  double samples_per_wave = 2.5;
  double wavelength_periods_of_tracker = 0.0;
  double light_N = 0.3;
  double hard_N = 4.0;
  double force_headroom = 0.98;
  double saturated_share = 0.002;
  double rows_lost_share = 0.02;
  double silent_s = 0.3;
  double marker_lost_s = 0.2;
  double marker_error_s = 0.5;
  double tilt_deg = 30.0;
  double tilt_rate_degps = 45.0;
  double doubling_back_m = 2e-3;
  double hysteresis = 0.15;
  double appear_s = 0.25;
  double vanish_s = 0.5;
  double shown_s = 1.5;
  double window_s = 0.5;

  template <class V>
  void visit(V& v) {
    v.field("finest_wavelength_mm", finest_wavelength_mm, "shortest wavelength of the texture to be measured, mm",
            {0.01, 1000.0});
    v.field("samples_per_wave", samples_per_wave, "samples of the accelerometer that such a wave needs", {2.0, 100.0});
    v.field("wavelength_periods_of_tracker", wavelength_periods_of_tracker,
            "poses that such a wave needs, where the accelerometer cannot carry it; 0: none", {0.0, 100.0});
    v.field("light_N", light_N, "a mean force in contact below this is too light, N", {0.0, 1e3});
    v.field("hard_N", hard_N, "a mean force above this is too hard, N", {0.0, 1e3});
    v.field("force_headroom", force_headroom, "share of the force converter's range that counts as its end",
            {0.5, 1.0});
    v.field("saturated_share", saturated_share, "share of rows at the accelerometer's limits", {0.0, 1.0});
    v.field("rows_lost_share", rows_lost_share, "share of rows lost", {0.0, 1.0});
    v.field("silent_s", silent_s, "without a row from the probe, s", {0.01, 60.0});
    v.field("marker_lost_s", marker_lost_s, "without a pose, s", {0.01, 60.0});
    v.field("marker_error_s", marker_error_s, "time without a pose after which heights are missing, s", {0.01, 60.0});
    v.field("tilt_deg", tilt_deg, "angle between the probe's axis and the surface's normal, degrees", {1.0, 90.0});
    v.field("tilt_rate_degps", tilt_rate_degps, "angular speed of the probe, degrees/s", {1.0, 1e4});
    v.field("doubling_back_m", doubling_back_m, "distance back along the stroke, m", {0.0, 1.0});
    v.field("hysteresis", hysteresis, "share of a limit by which it must be better for a hint to go", {0.0, 0.9});
    v.field("appear_s", appear_s, "a condition shorter than this gives no hint, s", {0.0, 60.0});
    v.field("vanish_s", vanish_s, "a hint goes after things have been better for this time, s", {0.0, 60.0});
    v.field("shown_s", shown_s, "shortest time for which a hint is shown, s", {0.0, 60.0});
    v.field("window_s", window_s, "time over which forces, speeds and shares are taken, s", {0.05, 60.0});
  }
};

}  // namespace asperity
