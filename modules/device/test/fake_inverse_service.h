#pragma once

#include <chrono>
#include <memory>
#include <string>

#include <Eigen/Core>

namespace asperity {

struct FakeInverseConfig {
  std::string version = "3.5.0";
  std::string device_id = "049D";  // empty: no device is plugged in
  // A hand on the cursor: m a = pull + force − b v. Axes of the service: x right, y forward, z up.
  double mass_kg = 0.2;
  double damping_N_s_per_m = 40.0;
  Eigen::Vector3d pull_N{0.0, 0.0, -1.0};
  Eigen::Vector3d start_m = Eigen::Vector3d::Zero();
  // Haply does not state how long a force outlives its message. The worst is until the session ends.
  double force_holds_s = 1e6;
};

// What clients did so far.
struct FakeInverseLog {
  int messages = 0;
  int answers = 0;
  int profiles = 0;                                   // messages that configured the session's profile
  bool profile_first = false;                         // the first one did
  int unreadable = 0;                                 // not JSON, or without a force under this version's key
  int sessions_closed = 0;                            // with a WebSocket close handshake
  Eigen::Vector3d force_N = Eigen::Vector3d::Zero();  // of the last message
};

// What a service or its line can do to states. The messages are obeyed all the same.
enum class ServiceTrouble {
  kNone,
  kGlitch,      // eight states are 30 mm too low
  kDuplicate,   // each comes twice
  kFast,        // three more that nobody asked for
  kOutOfOrder,  // every other one comes after its follower
};

// An Inverse Service on a loopback port of its own, as docs.haply.co describes 3.x: GET /version and /devices, a
// WebSocket whose first message is the inventory and which answers each message by exactly one state. It serves in
// real time. All methods may be called from any thread.
class FakeInverseService {
 public:
  explicit FakeInverseService(const FakeInverseConfig& config = {});
  ~FakeInverseService();

  int port() const;
  FakeInverseLog log() const;
  Eigen::Vector3d position_m() const;
  Eigen::Vector3d applied_N() const;  // what the motors give now

  void unplug();  // the device leaves the state frames
  void drop();    // connections are cut without a word
  // Messages are taken but not answered until it ends. Who hangs cannot be told: 0.1 s later the fake lets go by
  // itself.
  void stall(bool on);
  void answer_with(const std::string& text);          // instead of states
  void answer_after(std::chrono::microseconds time);  // each state comes this late, and is as old
  void trouble(ServiceTrouble kind);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
