#include "asperity/device/device_caps.h"

#include <algorithm>

#include <fmt/format.h>

#include "asperity/device/make_safe.h"

namespace asperity {
namespace {

std::string name_of(const DeviceInfo& info) { return info.model.empty() ? info.name : info.model; }

void cap_stiffness(DeviceCaps& caps, const DeviceInfo& info, const SafetyConfig& safety, double rate_Hz) {
  if (info.max_stiffness_N_per_m > 0.0) {
    caps.stiffness_N_per_m = info.max_stiffness_N_per_m;
    caps.stiffness_reason = fmt::format("{} renders at most {:.4g} N/m", name_of(info), info.max_stiffness_N_per_m);
  }
  const double damping = safety.assumed_damping_N_s_per_m + (safety.passivity ? safety.max_damping_N_s_per_m : 0.0);
  const double passive = 2.0 * damping * rate_Hz;
  if (damping > 0.0 && passive < caps.stiffness_N_per_m) {
    caps.stiffness_N_per_m = passive;
    caps.stiffness_reason = fmt::format(
        "at {:.4g} Hz a spring above 2 b/T = {:.4g} N/m creates more energy than a damping of {:.4g} N s/m "
        "takes (Colgate and Brown 1994)",
        rate_Hz, passive, damping);
  }
}

void cap_textures(DeviceCaps& caps, const DeviceInfo& info, double rate_Hz, const DeviceCapsConfig& config) {
  const double stable = config.texture_stiffness_N_per_m_kHz * rate_Hz * 1e-3;
  if (stable < caps.stiffness_N_per_m) {
    caps.texture_stiffness_N_per_m = stable;
    caps.texture_stiffness_reason = fmt::format(
        "at {:.4g} Hz textures stiffer than {:.4g} N/m buzz by themselves (Choi and Tan 2004)", rate_Hz, stable);
  } else {
    caps.texture_stiffness_N_per_m = caps.stiffness_N_per_m;
    caps.texture_stiffness_reason = caps.stiffness_reason;
  }
  if (info.bandwidth_Hz > 0.0) {
    const double bandwidth_Hz = std::min(info.bandwidth_Hz, 0.5 * rate_Hz);
    caps.texture_cycles_per_mm = bandwidth_Hz / (config.stroke_mps * 1e3);
    caps.texture_bandwidth_reason = fmt::format(
        "{} at {:.4g} Hz renders up to {:.4g} Hz, which at {:.4g} mm/s are {:.4g} cycles/mm "
        "(Campion and Hayward 2005)",
        name_of(info), rate_Hz, bandwidth_Hz, 1e3 * config.stroke_mps, caps.texture_cycles_per_mm);
  }
}

}  // namespace

DeviceCaps find_device_caps(const DeviceInfo& info, const SafetyConfig& safety, double rate_Hz,
                            const DeviceCapsConfig& config) {
  DeviceCaps caps;
  caps.force_N = lower_to_device(safety, info).max_force_N;
  cap_stiffness(caps, info, safety, rate_Hz);
  cap_textures(caps, info, rate_Hz, config);
  return caps;
}

}  // namespace asperity
