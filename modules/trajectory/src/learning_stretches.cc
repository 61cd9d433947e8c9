#include "learning_stretches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fused_problem.h"
#include "fused_setup.h"

namespace asperity::inertial_smoother {

namespace {

using Eigen::Vector3d;

// What a stretch of the recording is like, for the order of choice.
struct Character {
  double moving_mps2 = 0.0;  // standard deviation of the specific force
  double rough_m = 0.0;      // mean of the fourth difference of the poses' positions, as of white noise
};

std::size_t stretch_at(double t, double begin, std::size_t count) {
  const double place = std::floor((t - begin) / kStretchLength_s);
  return std::min(count - 1, static_cast<std::size_t>(std::max(0.0, place)));
}

std::vector<Character> characters(const Problem& problem, std::size_t count) {
  const double begin = problem.knots.front().t;
  std::vector<Character> out(count);
  std::vector<Vector3d> sum(count, Vector3d::Zero());
  std::vector<double> squares(count, 0.0), knots(count, 0.0), differences(count, 0.0);
  for (std::size_t k = 0; k < problem.knots.size(); ++k) {
    const Knot knot = problem.knots[k];
    const std::size_t i = stretch_at(knot.t, begin, count);
    sum[i] += knot.f;
    squares[i] += knot.f.squaredNorm();
    knots[i] += 1.0;
  }
  std::vector<const Epoch*> posed;
  for (const Epoch& epoch : problem.epochs) {
    if (epoch.pose >= 0) posed.push_back(&epoch);
  }
  for (std::size_t k = 2; k + 2 < posed.size(); ++k) {
    const auto at = [&](std::size_t j) -> const Vector3d& {
      return problem.poses[static_cast<std::size_t>(posed[j]->pose)].translation_m;
    };
    const Vector3d fourth = at(k - 2) - 4.0 * at(k - 1) + 6.0 * at(k) - 4.0 * at(k + 1) + at(k + 2);
    const std::size_t i = stretch_at(problem.knots[posed[k]->knot].t, begin, count);
    out[i].rough_m += fourth.norm() / std::sqrt(70.0);
    differences[i] += 1.0;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double n = std::max(1.0, knots[i]);
    out[i].moving_mps2 = std::sqrt(std::max(0.0, squares[i] / n - (sum[i] / n).squaredNorm()));
    out[i].rough_m /= std::max(1.0, differences[i]);
  }
  return out;
}

// Of `order` a third of all, evenly spaced from its first to its last, or the next that is not chosen yet.
void choose(const std::vector<std::size_t>& order, std::vector<bool>& chosen) {
  constexpr int kThird = kStretches / 3;
  for (int j = 0; j < kThird; ++j) {
    std::size_t place = static_cast<std::size_t>(j) * (order.size() - 1) / (kThird - 1);
    while (chosen[order[place % order.size()]]) ++place;
    chosen[order[place % order.size()]] = true;
  }
}

// The epochs from the first with a pose at or after the stretch's begin to the last with one before its end.
std::pair<std::size_t, std::size_t> epochs_of(const Problem& problem, const Stretch& stretch) {
  std::size_t first = problem.epochs.size(), last = 0;
  for (std::size_t e = 0; e < problem.epochs.size(); ++e) {
    const double t = problem.knots[problem.epochs[e].knot].t;
    if (problem.epochs[e].pose < 0 || t < stretch.begin || t >= stretch.end) continue;
    first = std::min(first, e);
    last = e;
  }
  return {first, last};
}

}  // namespace

std::vector<Stretch> choose_stretches(const Problem& problem) {
  const double begin = problem.knots.front().t;
  const double length_s = problem.knots.back().t - begin;
  if (length_s <= 2.0 * kStretches * kStretchLength_s) return {};
  const auto count = static_cast<std::size_t>(std::floor(length_s / kStretchLength_s));
  const std::vector<Character> like = characters(problem, count);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::vector<bool> chosen(count, false);
  const auto in_order = [&](double Character::*of) {
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      if (like[a].*of != like[b].*of) return like[a].*of < like[b].*of;
      return a < b;
    });
  };
  choose(order, chosen);
  in_order(&Character::moving_mps2);
  choose(order, chosen);
  in_order(&Character::rough_m);
  choose(order, chosen);
  std::vector<Stretch> out;
  for (std::size_t i = 0; i < count; ++i) {
    if (!chosen[i]) continue;
    const double at = begin + static_cast<double>(i) * kStretchLength_s;
    if (!out.empty() && out.back().end == at) {
      out.back().end = at + kStretchLength_s;  // neighbours are one
    } else {
      out.push_back({at, at + kStretchLength_s});
    }
  }
  return out;
}

Problem problem_of_stretches(const Problem& problem, const std::vector<Stretch>& stretches) {
  Problem out = problem;
  out.knots.clear();
  out.epochs.clear();
  for (const Stretch& stretch : stretches) {
    const auto [first, last] = epochs_of(problem, stretch);
    if (first >= last) continue;  // no poses: nothing to learn from
    const std::size_t knot = problem.epochs[first].knot, end_knot = problem.epochs[last].knot;
    const std::size_t moved = out.knots.size();
    const Pose pose = typical_pose(problem, first);
    if (out.epochs.empty()) {
      out.start.q = pose.rotation;
      out.start.p = pose * out.start.lever;
    } else {
      out.restarts.push_back({out.epochs.size(), pose});
    }
    for (std::size_t e = first; e <= last; ++e) {
      out.epochs.push_back({problem.epochs[e].knot - knot + moved, problem.epochs[e].pose});
    }
    out.knots.append(problem.knots, knot, end_knot + 1);
  }
  if (out.epochs.empty()) return problem;
  out.start_covariance = out.restart_covariance;
  tie_place_to_lever(out);
  return out;
}

}  // namespace asperity::inertial_smoother
