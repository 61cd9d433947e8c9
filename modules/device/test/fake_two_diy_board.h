#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

namespace asperity {

struct FakeBoardConfig {
  bool directions = false;  // firmware that takes directions
  double mass_kg = 0.2;
  double damping_N_s_per_m = 40.0;
  Eigen::Vector2d pull_N{0.0, 1.0};  // away from the motors
  double lifts_every_s = 0.0;        // in the last third of each such time the pull is the other way; 0: never
};

// What a board or its line can do to answers. The messages are obeyed all the same.
enum class BoardTrouble {
  kNone,
  kMute,        // no answer
  kGlitch,      // eight answers state a place far away
  kDuplicate,   // each answer comes twice
  kLate,        // each comes 60 ms late
  kSlow,        // each comes 15 ms late
  kFast,        // three more that nobody asked for
  kOutOfOrder,  // every other one comes after its follower
};

// A hAPI board on a pseudo-terminal, with a pantograph of l 0.05, L 0.07, d 0.02 m whose tip is a damped mass. It
// starts as a 2diy is calibrated, arms at 180° and 0°; its encoders count from there. It speaks only when asked, holds
// the last torques for ever, and needs to be set up first. Its mechanics are another derivation than the driver's:
// inverse kinematics by the law of cosines, the Jacobian by differences. Any thread.
class FakeTwoDiyBoard {
 public:
  explicit FakeTwoDiyBoard(const FakeBoardConfig& config = {});
  ~FakeTwoDiyBoard();

  std::string port() const;
  Eigen::Vector2d p_m() const;
  Eigen::Vector2d torque_N_m() const;
  Eigen::Vector2d force_N() const;  // of those torques at the tip
  int resets() const;

  void unplug();
  void stall(bool on);
  void answer_nonsense();
  void trouble(BoardTrouble kind);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The angles of the arms for a tip at `p_m`, by the law of cosines, the elbows outward.
Eigen::Vector2d pantograph_angles_rad(const Eigen::Vector2d& p_m);

}  // namespace asperity
