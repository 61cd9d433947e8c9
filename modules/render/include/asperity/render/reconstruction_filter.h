#pragma once

#include <limits>

#include "asperity/base/problem.h"
#include "asperity/render/render_texture.h"

namespace asperity {

// A device as far as textures depend on it. nan: not known, and not a limit then.
struct TextureDevice {
  double bandwidth_Hz = std::numeric_limits<double>::quiet_NaN();           // up to which it renders faithfully
  double rate_Hz = 1000.0;                                                  // of the servo
  double highest_speed_mps = 0.1;                                           // of a stroke
  double position_resolution_m = std::numeric_limits<double>::quiet_NaN();  // of its sensors
  double damping_N_s_per_m = std::numeric_limits<double>::quiet_NaN();      // its own, viscous, hand left out
  double max_force_N = std::numeric_limits<double>::quiet_NaN();
};

// The shortest wave that the device can render at the highest speed, as RenderTextureConfig::cutoff_cycles_per_mm
// (Campion and Hayward 2005; seed §2.1): a wave of f cycles a metre under a tip of v m/s is one of f v Hz, so
//   f = min(bandwidth, rate / 4) / v,
// and no wave shorter than four steps of the position's sensors. A quarter of the rate: there the first image of the
// held samples has a third of the wave's amplitude (sin(πf/r)/(πf/r) at r − f against f). Throws Error for a rate or
// speed that is not positive, and for a bandwidth or resolution that is known and is not.
double reconstruction_cutoff_cycles_per_mm(const TextureDevice& device);

// How a texture stands on a device.
struct TextureFit {
  double steepest = 0.0;           // largest |∇H|
  double most_curved_per_m = 0.0;  // largest |∂²H|
  // How many times stiffer than the flat wall the loop becomes: a bound of ‖∂force/∂position‖ / k_s (the
  // characteristic number of Campion and Hayward 2008). 1 for models without a place.
  double loop_gain = 1.0;
  double highest_stiffness_N_per_m = 0.0;  // 2 b / (T loop_gain), passive below (Colgate and Schenkel 1997); nan
  double most_force_N = 0.0;               // of the texture alone, wholly pressed in
  Problems problems;                       // in words, for whoever chooses stiffness and texture
};

// Measures the texture and compares it with the device at the stiffness k_s and compliance k_c of a place. Choi and
// Tan (2004, seed §2.3) felt noise that was none of the texture's from 0.45 N/mm on at 1 kHz, in their way of rendering
// along the normal; above that a problem says so, but nothing is changed. Throws as above.
TextureFit fit_texture_to_device(const RenderTexture& texture, double stiffness_N_per_m, double compliance_kc,
                                 const TextureDevice& device);

}  // namespace asperity
