#include "asperity/device/device_caps.h"

#include <algorithm>

#include <fmt/format.h>

#include "asperity/device/make_safe.h"

namespace asperity {
namespace {

std::string name_of(const DeviceInfo& info) { return info.model.empty() ? info.name : info.model; }

// For the sentences about scenes that are felt larger or smaller than they are.
std::string at_scale(double scale) {
  return scale == 1.0 ? "" : fmt::format("; a metre of the hand is {:.4g} m of the scene", scale);
}

struct Service {
  double rate_Hz = 0.0;   // at which forces reach the hand
  double slowness = 1.0;  // that over the rate which the device wants, 1 at most
  double scale = 1.0;
};

void cap_stiffness(DeviceCaps& caps, const DeviceInfo& info, const Service& service, double damping) {
  if (info.max_stiffness_N_per_m > 0.0) {
    const double stated = info.max_stiffness_N_per_m * service.slowness;
    caps.stiffness_N_per_m = stated / service.scale;
    caps.stiffness_reason = fmt::format("{} at {:.4g} Hz renders at most {:.4g} N/m{}", name_of(info), service.rate_Hz,
                                        stated, at_scale(service.scale));
  } else if (damping > 0.0) {
    const double passive = 2.0 * damping * service.rate_Hz;
    caps.stiffness_N_per_m = passive / service.scale;
    caps.stiffness_reason = fmt::format(
        "at {:.4g} Hz a spring above 2 b/T = {:.4g} N/m creates more energy than a damping of {:.4g} N s/m "
        "takes (Colgate and Brown 1994){}",
        service.rate_Hz, passive, damping, at_scale(service.scale));
  }
}

void cap_textures(DeviceCaps& caps, const DeviceInfo& info, const Service& service, const DeviceCapsConfig& config) {
  const double stable = config.texture_stiffness_N_per_m_kHz * service.rate_Hz * 1e-3;
  if (stable / service.scale < caps.stiffness_N_per_m) {
    caps.texture_stiffness_N_per_m = stable / service.scale;
    caps.texture_stiffness_reason =
        fmt::format("at {:.4g} Hz textures stiffer than {:.4g} N/m buzz by themselves (Choi and Tan 2004){}",
                    service.rate_Hz, stable, at_scale(service.scale));
  } else {
    caps.texture_stiffness_N_per_m = caps.stiffness_N_per_m;
    caps.texture_stiffness_reason = caps.stiffness_reason;
  }
  if (info.bandwidth_Hz > 0.0) {
    const double bandwidth_Hz = std::min(info.bandwidth_Hz, 0.5 * service.rate_Hz);
    const double cycles_per_mm = bandwidth_Hz / (config.stroke_mps * 1e3);
    caps.texture_cycles_per_mm = cycles_per_mm / service.scale;
    caps.texture_bandwidth_reason = fmt::format(
        "{} at {:.4g} Hz renders up to {:.4g} Hz, which at {:.4g} mm/s are {:.4g} cycles/mm "
        "(Campion and Hayward 2005){}",
        name_of(info), service.rate_Hz, bandwidth_Hz, 1e3 * config.stroke_mps, cycles_per_mm, at_scale(service.scale));
  }
}

}  // namespace

DeviceCaps find_device_caps(const DeviceInfo& info, const ServoConfig& servo, const DeviceCapsConfig& config) {
  Service service;
  service.rate_Hz = std::min(servo.rate_Hz, info.rate_Hz);
  service.slowness = service.rate_Hz / info.rate_Hz;
  service.scale = servo.frame.scale;
  DeviceCaps caps;
  caps.force_N = lower_to_device(servo.safety, info).max_force_N;
  cap_stiffness(caps, info, service, servo.safety.assumed_damping_N_s_per_m);
  cap_textures(caps, info, service, config);
  return caps;
}

}  // namespace asperity
