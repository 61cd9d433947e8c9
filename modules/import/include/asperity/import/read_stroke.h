#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/import/import_table.h"
#include "asperity/import/mapping_config.h"
#include "asperity/import/stroke.h"

namespace asperity {

struct StrokeImportConfig {
  double high_pass_Hz = 10.0;
  double speed_mps = 0.0;
  double force_N = 0.0;
  double contact_N = 0.05;
  double noise_mps2 = 0.0;

  template <class V>
  void visit(V& v) {
    v.field("high_pass_Hz", high_pass_Hz, "gravity and the hand's motion below it are taken off the acceleration",
            {0.1, 1e4});
    v.field("speed_mps", speed_mps, "of a stroke without positions, as it was held; 0: not known", {0.0, 10.0});
    v.field("force_N", force_N, "of a stroke without a force, as it was held; 0: not known", {0.0, 1e3});
    v.field("contact_N", contact_N, "from this force on the tip touches", {1e-4, 100.0});
    v.field("noise_mps2", noise_mps2,
            "RMS of the sensor's noise above 40 Hz, where no part of the stroke is quiet; 0: "
            "not known",
            {0.0, 1e3});
  }
};

// Where the series come from. `imu` is one file, or one an axis. Without it all columns are in `pose`; without `force`
// the force is in the first of the others that has one.
struct StrokeFiles {
  std::vector<std::filesystem::path> imu;
  std::filesystem::path pose, force;
};

struct StrokeReading {
  Stroke stroke;
  std::vector<ImportTable> tables;  // what was read, with what its columns mean
  std::vector<std::string> doubts;  // what cannot be right, a sentence each: see check_stroke
};

// A stroke of an acceleration of one to three axes and, where there are files of them, of positions (px, py, pz: one to
// three) and a force (f, or fx fy fz, of which the length is taken). Each file has times, or a rate of its own; files
// without times begin together.
//
// 1. The acceleration is put on even times at its mean rate (straight lines), and its axes are joined to one series by
//    DFT321 (Landin, Romano, McMahan and Kuchenbecker 2010): |X| = √Σ|X_i|², with the phase of Σ X_i. Then a zero-phase
//    high-pass.
// 2. The speed is the difference of the positions over 40 ms (two intervals at least) to either side. Positions, speed
//    and force are put on the same times by straight lines.
// 3. The time that all series have is kept: half a second at least.
//
// Throws Error naming the file where one cannot be read, the rate of an axis is below 200 Hz or differs from the first
// one's by more than a hundredth, an axis, the positions or the force have a gap of more than ten intervals, more than
// one time in a hundred occurs twice (too coarse a clock), the acceleration never changes, and where times do not
// overlap.
StrokeReading read_stroke(const StrokeFiles& files, const MappingConfig& mapping, const StrokeImportConfig& config);

// What cannot be right about the units: the mean of three axes that is gravity in another unit, an axis whose unit is a
// guess without gravity to judge by, an axis with an RMS that no tool has (below 1e-4 or above 500 m/s²; one that never
// changes is left out), a speed above 5 m/s, a force above 100 N, values that fit a thousand times larger.
// `acceleration_mean_mps2` is the length of the axes' mean before the high-pass, `axis_rms_mps2` each one's RMS behind
// it, in the order of the tables and of ax, ay, az in them.
std::vector<std::string> check_stroke(const Stroke& stroke, double acceleration_mean_mps2,
                                      const std::vector<double>& axis_rms_mps2, const std::vector<ImportTable>& tables);

// Files, columns and rates, as a stroke's folder keeps them.
std::vector<StrokeOrigin> stroke_origins(const std::vector<ImportTable>& tables);

}  // namespace asperity
