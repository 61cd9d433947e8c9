#pragma once

#include "asperity/base/problem.h"
#include "asperity/device/device_caps.h"
#include "asperity/render/render_texture.h"

namespace asperity {

// How a texture behaves on a device.
struct TextureOnDevice {
  double steepest = 0.0;           // largest |∇H|
  double most_curved_per_m = 0.0;  // largest |∂²H|
  // How many times stiffer than the flat wall the loop becomes: a bound of ‖∂force/∂position‖ / k_s (the
  // characteristic number of Campion and Hayward 2008). 1 for models without a position.
  double loop_gain = 1.0;
  double highest_stiffness_N_per_m = 0.0;  // the device's over loop_gain (Colgate and Schenkel 1997)
  double most_force_N = 0.0;               // of the texture alone, wholly pressed in
  Problems problems;                       // in words, for the person who chooses stiffness and texture
};

// Measures the texture and compares it with what the device can render, at the stiffness k_s and compliance k_c of a
// place. Nothing is changed: that is cap_scene(). Throws Error for a stiffness that is not positive.
TextureOnDevice check_texture_on_device(const RenderTexture& texture, double stiffness_N_per_m, double compliance_kc,
                                        const DeviceCaps& caps);

}  // namespace asperity
