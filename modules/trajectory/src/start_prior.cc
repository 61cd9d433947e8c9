// What is known where the motion begins, at the recording's start and at each stretch's.

#include <array>

#include "inertial_model.h"

namespace asperity::inertial_smoother {

namespace {

// Components of the first state's covariance.
struct Block {
  Component component;
  int at;
  int size;
};

std::array<Block, 5> start_blocks(const Layout& layout) {
  return {Block{kAccelMatrix, layout.accel_matrix, 9}, Block{kGyroMatrix, layout.gyro_matrix, 9},
          Block{kGravity, layout.gravity, 3}, Block{kSlow, layout.slow, 3},
          Block{kSlowTurn, layout.slow < 0 ? -1 : layout.slow + 3, 3}};
}

}  // namespace

Square start_covariance(const Problem& problem) {
  Square P = problem.start_covariance;
  for (const Block& block : start_blocks(problem.layout)) {
    if (block.at >= 0) P.block(block.at, block.at, block.size, block.size) *= problem.factors[block.component];
  }
  return P;
}

namespace {

void add_block_score(const Problem& problem, const Block& block, const State& lambda, const Square& Lambda,
                     NoiseScore& score) {
  if (block.at < 0) return;
  for (int i = block.at; i < block.at + block.size; ++i) {
    const double variance = problem.factors[block.component] * problem.start_covariance(i, i);
    score.add(block.component, variance * lambda[i] * lambda[i], variance * Lambda(i, i));
  }
}

bool begins_anew(const Block& block) { return block.component == kSlow || block.component == kSlowTurn; }

// Φ over a restart: of the motion only the place depends on what was before, by the lever.
Square restart_transition(const Layout& layout, const Restart& restart) {
  Square out = Square::Identity(layout.size, layout.size);
  out.topLeftCorner<kBase, kBase>().setZero();
  if (layout.slow >= 0) out.block<6, 6>(layout.slow, layout.slow).setZero();
  if (layout.lever >= 0) out.block<3, 3>(kP, layout.lever) = restart.pose.rotation.toRotationMatrix();
  return out;
}

}  // namespace

void add_start_score(const Problem& problem, const State& lambda, const Square& Lambda, NoiseScore& score) {
  for (const Block& block : start_blocks(problem.layout)) add_block_score(problem, block, lambda, Lambda, score);
}

void restart_motion(const Problem& problem, const Restart& restart, Nominal& x, Square& P) {
  const Layout& layout = problem.layout;
  const Square phi = restart_transition(layout, restart);
  P = (phi * P * phi.transpose()).eval();
  P.topLeftCorner<kBase, kBase>() += problem.restart_covariance.topLeftCorner<kBase, kBase>();
  for (const Block& block : start_blocks(layout)) {
    if (block.at < 0 || !begins_anew(block)) continue;
    P.diagonal().segment(block.at, block.size) +=
        problem.factors[block.component] * problem.restart_covariance.diagonal().segment(block.at, block.size);
  }
  x.p = restart.pose * x.lever;
  x.q = restart.pose.rotation;
  x.v.setZero();
  x.ba = problem.start.ba;
  x.bg = problem.start.bg;
  x.slow.setZero();
}

void restart_back(const Problem& problem, const Restart& restart, State& lambda, Square& Lambda, NoiseScore& score) {
  for (const Block& block : start_blocks(problem.layout)) {
    if (begins_anew(block)) add_block_score(problem, block, lambda, Lambda, score);
  }
  const Square phi = restart_transition(problem.layout, restart);
  lambda = (phi.transpose() * lambda).eval();
  Lambda = (phi.transpose() * Lambda * phi).eval();
}

}  // namespace asperity::inertial_smoother
