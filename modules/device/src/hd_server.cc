#include "hd_server.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string>
#include <thread>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/supervisor.h"
#include "real_time.h"

namespace asperity::hd {

namespace {

constexpr double kMillimetre_m = 1e-3;
constexpr double kReturn_s = 0.02;  // in which the force comes back after it was not renewed
constexpr int kMostErrorsAFrame = 32;
constexpr int kLowestRate_Hz = 100;
constexpr int kHighestRate_Hz = 10000;
constexpr std::chrono::milliseconds kFirstFrameWithin{1000};
constexpr std::chrono::milliseconds kLastFramesWithin{200};

}  // namespace

Server::Server(Mailbox& mailbox) : mailbox_(mailbox), api_(load_api(mailbox.library.data())) {
  const std::string name = mailbox.device.data();
  handle_ = api_.init_device(name.empty() ? nullptr : name.c_str());
  const unsigned error = drain_first_error();
  if (handle_ == kInvalidHandle) {
    throw Error("openhaptics: no device" + (name.empty() ? std::string() : " '" + printable(name) + "'") +
                (error != 0 ? ": " + error_text(error) : std::string()));
  }
  try {
    describe();
    start();
  } catch (...) {
    close();
    throw;
  }
}

void Server::close() noexcept {
  if (closed_) return;
  closed_ = true;
  mailbox_.ending.store(true);
  if (scheduled_) {
    // Two whole frames after the flag: the force of zero has been sent.
    const std::uint64_t first = mailbox_.silent_frames.load();
    const auto until = std::chrono::steady_clock::now() + kLastFramesWithin;
    while (mailbox_.silent_frames.load() < first + 2 && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    api_.disable(kForceOutput);
    api_.stop_scheduler();
    api_.unschedule(schedule_);
  }
  api_.disable_device(handle_);
  drain_first_error();
}

// The oldest thing the driver complains of, 0 if of nothing; its list is empty afterwards.
unsigned Server::drain_first_error() noexcept {
  unsigned first = 0;
  for (int i = 0; i < kMostErrorsAFrame; ++i) {
    const unsigned code = api_.get_error().code;
    if (code == 0) break;
    first = code;
  }
  return first;
}

double Server::limit(unsigned parameter) noexcept {
  double value = Description::kNone;
  api_.get_doubles(parameter, &value);
  return drain_first_error() == 0 && std::isfinite(value) && value > 0.0 ? value : Description::kNone;
}

void Server::describe() {
  Description& out = mailbox_.description;
  if (api_.get_string != nullptr) {
    const char* const model = api_.get_string(kDeviceModel);
    if (drain_first_error() == 0 && model != nullptr) std::strncpy(out.model.data(), model, out.model.size() - 1);
  }
  out.rate_Hz = mailbox_.rate_Hz;
  out.max_force_N = limit(kNominalMaxForce_N);
  out.max_continuous_force_N = limit(kMaxContinuousForce_N);
  out.max_stiffness_N_per_m = limit(kNominalMaxStiffness_N_per_mm) / kMillimetre_m;
  std::array<double, 6> box_mm{};
  api_.get_doubles(kUsableWorkspace_mm, box_mm.data());
  const Eigen::Vector3d low_mm(box_mm.data());
  const Eigen::Vector3d high_mm(box_mm.data() + 3);
  if (drain_first_error() != 0 || !low_mm.allFinite() || !high_mm.allFinite() ||
      !(low_mm.array() < high_mm.array()).all())
    return;
  Eigen::Vector3d::Map(out.workspace_min_m.data()) = kMillimetre_m * low_mm;
  Eigen::Vector3d::Map(out.workspace_max_m.data()) = kMillimetre_m * high_mm;
}

void Server::start() {
  double& rate_Hz = mailbox_.description.rate_Hz;
  api_.set_scheduler_rate(static_cast<unsigned long>(std::lround(rate_Hz)));
  drain_first_error();  // a device that has one rate only keeps it
  int told_Hz = 0;
  api_.get_integers(kUpdateRate_Hz, &told_Hz);
  if (drain_first_error() == 0 && told_Hz >= kLowestRate_Hz && told_Hz <= kHighestRate_Hz) rate_Hz = told_Hz;
  gain_step_ = 1.0 / (kReturn_s * rate_Hz);
  api_.enable(kForceOutput);
  api_.enable(kMaxForceClamping);
  api_.enable(kForceRamping);
  schedule_ = api_.schedule_asynchronous(&Server::on_frame, this, kDefaultPriority);
  scheduled_ = true;
  api_.start_scheduler();
  if (const unsigned error = drain_first_error(); error != 0) {
    throw Error("openhaptics: the device does not start: " + error_text(error));
  }
  const auto until = std::chrono::steady_clock::now() + kFirstFrameWithin;
  while (mailbox_.readings_taken.load() == 0) {
    if (const unsigned code = mailbox_.fault_code.load(); code != 0) throw Error("openhaptics: " + error_text(code));
    if (std::chrono::steady_clock::now() > until) {
      const unsigned code = mailbox_.other_code.load();
      throw Error("openhaptics: the driver's scheduler does not call back" +
                  (code != 0 ? ": " + error_text(code) : std::string()));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

bool Server::is_driven(const Command& command, std::int64_t now_ns) noexcept {
  if (command.sequence != taken_) renewed_ns_ = now_ns;
  taken_ = command.sequence;
  const auto lasts_ns = static_cast<std::int64_t>(mailbox_.force_timeout_s * 1e9);
  return !mailbox_.ending.load(std::memory_order_acquire) && mailbox_.fault_code.load(std::memory_order_relaxed) == 0 &&
         taken_ != 0 && now_ns - renewed_ns_ <= lasts_ns && command.force_N.allFinite();
}

// One frame of the driver's thread.
unsigned Server::frame() noexcept {
  if (!begun_) {
    begun_ = true;
    std::string refused;
    take_real_time_priority(refused);
  }
  const bool ending = mailbox_.ending.load(std::memory_order_acquire);
  const Command command = mailbox_.commands.take();
  const bool driven = is_driven(command, boot_now_ns());
  gain_ = driven ? std::min(1.0, gain_ + gain_step_) : 0.0;
  const Eigen::Vector3d force_N = driven ? Eigen::Vector3d(gain_ * command.force_N) : Eigen::Vector3d::Zero();

  Eigen::Vector3d p_mm = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d v_mmps = p_mm;
  int buttons = 0;
  api_.begin_frame(handle_);
  api_.get_doubles(kCurrentPosition_mm, p_mm.data());
  api_.get_doubles(kCurrentVelocity_mmps, v_mmps.data());
  api_.get_integers(kCurrentButtons, &buttons);
  api_.set_doubles(kCurrentForce_N, force_N.data());
  api_.end_frame(handle_);

  if (note_errors() && p_mm.allFinite() && v_mmps.allFinite()) {
    reading_.p_m = kMillimetre_m * p_mm;
    reading_.v_mps = kMillimetre_m * v_mmps;
    reading_.buttons = static_cast<std::uint32_t>(buttons);
    ++reading_.sequence;
    mailbox_.readings.publish(reading_);
    mailbox_.readings_taken.fetch_add(1, std::memory_order_release);
  }
  mailbox_.frames.fetch_add(1, std::memory_order_release);
  if (ending) mailbox_.silent_frames.fetch_add(1, std::memory_order_release);
  return kCallbackContinue;
}

// Takes the driver's complaints about this frame; false if what was read in it is void.
bool Server::note_errors() noexcept {
  bool valid = true;
  for (int i = 0; i < kMostErrorsAFrame; ++i) {
    const unsigned code = api_.get_error().code;
    if (code == 0) break;
    const auto known = std::find(kWarnings.begin(), kWarnings.end(), code);
    if (known != kWarnings.end()) mailbox_.warned[static_cast<std::size_t>(known - kWarnings.begin())].store(true);
    const unsigned kind = code >> 8;
    if (kind == kCommError >> 8) {
      unsigned none = 0;
      mailbox_.fault_code.compare_exchange_strong(none, code);
    } else if (known == kWarnings.end()) {
      mailbox_.other_code.store(code);
    }
    if (kind != kWarmMotors >> 8) valid = false;  // those of force say nothing against the reading
  }
  return valid;
}

}  // namespace asperity::hd
