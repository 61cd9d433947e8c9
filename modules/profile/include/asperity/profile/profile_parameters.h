#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "asperity/base/nan.h"

namespace asperity {

// Parameters of one profile, P, R or W, by ISO 21920-2:2021; the name of each is that of the standard without the
// profile's letter: `q_m` is Pq, Rq or Wq. Heights count from the profile's mean line. docs/roughness.md has the
// formulas. A parameter that the profile does not define is nan.
struct ProfileParameters {
  // Heights: means over the sections …
  double p_m = kNan;  // highest point
  double v_m = kNan;  // depth of the lowest
  double z_m = kNan;  // both together
  // … over the whole length …
  double zx_m = kNan;  // largest z of a section
  double pt_m = kNan;
  double vt_m = kNan;
  double t_m = kNan;
  double a_m = kNan;
  double q_m = kNan;
  double sk = kNan;
  double ku = kNan;
  // … and over the profile elements.
  double c_m = kNan;       // mean of their heights
  double cx_m = kNan;      // largest of them
  double sm_m = kNan;      // mean of their widths
  double pc_per_m = kNan;  // their number in a length, 1/sm
  double cq_m = kNan;      // standard deviation of their heights
  double smx_m = kNan;     // largest of their widths
  double smq_m = kNan;     // standard deviation of their widths
  // Peaks and pits that stand out by a part of z.
  double five_p_m = kNan;   // mean height of the five highest peaks
  double five_v_m = kNan;   // mean depth of the five deepest pits
  double ten_z_m = kNan;    // both together
  double pd_per_m = kNan;   // peaks in a length
  double vd_per_m = kNan;   // pits
  double mpc_per_m = kNan;  // mean curvature of the peaks
  double mvc_per_m = kNan;  // of the pits; both positive
  // Slopes.
  double dq = kNan;    // root mean square
  double da = kNan;    // mean of their absolute values
  double dt = kNan;    // largest absolute value
  double dr = kNan;    // developed length over length, less 1
  double dl_m = kNan;  // developed length
  // Along the path.
  double al_m = kNan;  // distance at which the autocorrelation has fallen to 0.2
  double sw_m = kNan;  // wavelength of the largest amplitude
  // Material ratio curve.
  double mr = kNan;    // part above the level c of the settings, from the mean line
  double dc_m = kNan;  // fall of the curve between the two ratios of the settings
  double k_m = kNan;
  double pk_m = kNan;
  double vk_m = kNan;
  double mrk1 = kNan;
  double mrk2 = kNan;
  double vmp_m = kNan;  // volumes over length: of the material above 10 %, between it and 80 %,
  double vmc_m = kNan;
  double vvc_m = kNan;  // of the void between them, below 80 %
  double vvv_m = kNan;
  // Of a surface of two processes, on probability paper: plateaus over pits.
  double pq_m = kNan;  // slope of the plateaus, a standard deviation
  double vq_m = kNan;  // of the pits
  double mq = kNan;    // material ratio where they meet
};

// What a parameter is: how it grows with the heights and along the path, and the unit that it is shown in.
enum class ProfileQuantity { kHeight, kAlong, kNumber, kSlope, kRatio, kPerLength, kCurvature };

struct ProfileParameter {
  std::string_view suffix;  // after P, R or W
  double ProfileParameters::*value;
  ProfileQuantity quantity = ProfileQuantity::kHeight;
  bool hangs_on_extremes = false;  // on single heights, or high powers of them
};

inline constexpr std::array<ProfileParameter, 46> kProfileParameters{{
    {"a", &ProfileParameters::a_m},
    {"q", &ProfileParameters::q_m},
    {"p", &ProfileParameters::p_m, ProfileQuantity::kHeight, true},
    {"v", &ProfileParameters::v_m, ProfileQuantity::kHeight, true},
    {"z", &ProfileParameters::z_m, ProfileQuantity::kHeight, true},
    {"zx", &ProfileParameters::zx_m, ProfileQuantity::kHeight, true},
    {"pt", &ProfileParameters::pt_m, ProfileQuantity::kHeight, true},
    {"vt", &ProfileParameters::vt_m, ProfileQuantity::kHeight, true},
    {"t", &ProfileParameters::t_m, ProfileQuantity::kHeight, true},
    {"sk", &ProfileParameters::sk, ProfileQuantity::kNumber, true},
    {"ku", &ProfileParameters::ku, ProfileQuantity::kNumber, true},
    {"c", &ProfileParameters::c_m, ProfileQuantity::kHeight, true},
    {"cx", &ProfileParameters::cx_m, ProfileQuantity::kHeight, true},
    {"sm", &ProfileParameters::sm_m, ProfileQuantity::kAlong},
    {"pc", &ProfileParameters::pc_per_m, ProfileQuantity::kPerLength},
    {"cq", &ProfileParameters::cq_m, ProfileQuantity::kHeight, true},
    {"smx", &ProfileParameters::smx_m, ProfileQuantity::kAlong, true},
    {"smq", &ProfileParameters::smq_m, ProfileQuantity::kAlong},
    {"5p", &ProfileParameters::five_p_m, ProfileQuantity::kHeight, true},
    {"5v", &ProfileParameters::five_v_m, ProfileQuantity::kHeight, true},
    {"10z", &ProfileParameters::ten_z_m, ProfileQuantity::kHeight, true},
    {"pd", &ProfileParameters::pd_per_m, ProfileQuantity::kPerLength, true},
    {"vd", &ProfileParameters::vd_per_m, ProfileQuantity::kPerLength, true},
    {"mpc", &ProfileParameters::mpc_per_m, ProfileQuantity::kCurvature, true},
    {"mvc", &ProfileParameters::mvc_per_m, ProfileQuantity::kCurvature, true},
    {"dq", &ProfileParameters::dq, ProfileQuantity::kSlope},
    {"da", &ProfileParameters::da, ProfileQuantity::kSlope},
    {"dt", &ProfileParameters::dt, ProfileQuantity::kSlope, true},
    {"dr", &ProfileParameters::dr, ProfileQuantity::kNumber},
    {"dl", &ProfileParameters::dl_m, ProfileQuantity::kAlong},
    {"al", &ProfileParameters::al_m, ProfileQuantity::kAlong},
    {"sw", &ProfileParameters::sw_m, ProfileQuantity::kAlong},
    {"mr", &ProfileParameters::mr, ProfileQuantity::kRatio},
    {"dc", &ProfileParameters::dc_m},
    {"k", &ProfileParameters::k_m},
    {"pk", &ProfileParameters::pk_m, ProfileQuantity::kHeight, true},
    {"vk", &ProfileParameters::vk_m, ProfileQuantity::kHeight, true},
    {"mrk1", &ProfileParameters::mrk1, ProfileQuantity::kRatio},
    {"mrk2", &ProfileParameters::mrk2, ProfileQuantity::kRatio},
    {"vmp", &ProfileParameters::vmp_m, ProfileQuantity::kHeight, true},
    {"vmc", &ProfileParameters::vmc_m},
    {"vvc", &ProfileParameters::vvc_m},
    {"vvv", &ProfileParameters::vvv_m, ProfileQuantity::kHeight, true},
    {"pq", &ProfileParameters::pq_m},
    {"vq", &ProfileParameters::vq_m},
    {"mq", &ProfileParameters::mq, ProfileQuantity::kRatio},
}};

struct ProfileParametersResult : ProfileParameters {
  // Of the measurement of this stretch (measure_profile_texture.h); nan where not known.
  ProfileParameters standard_error;
  double length_m = 0.0;
  std::size_t samples = 0;
  std::size_t missing = 0;
  std::size_t sections_used = 0;
  std::size_t elements = 0;
};

}  // namespace asperity
