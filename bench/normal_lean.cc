// How far the normals of the fitted base lean from the object's own about the path, against what the result says of it:
// over the random scans of bench: coverage, by family and probe, with the normals as they are and without the fine
// motion's evidence (base.texture_axis_sigma_deg = 0).
//
//   normal_lean [--scans 100] [--seed 1] [--simulator ours|second] [--families …] [--probes …] [--list yes]
//   normal_lean --scan NUMBER --list yes        (one scan, by the number that the list has)
//
// The object is the plane or the cylinder from which the true tip has its true heights, fitted to them.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "asperity/base/error.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/signal/statistics.h"
#include "coverage/scan_case.h"
#include "read_options.h"

namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

// A cylinder of the curvature c (0: a plane) about a place: (turn about two tangents, height, axis' angle, c).
using Object = Eigen::Matrix<double, 5, 1>;

struct Place {
  Eigen::Vector3d p_m, x, y, n;
};

Eigen::Matrix3d axes_of(const Place& at, const Object& o) {
  const Eigen::Vector3d turn = o(0) * at.x + o(1) * at.y;
  Eigen::Matrix3d axes;
  axes << at.x, at.y, at.n;
  const double angle = turn.norm();
  if (angle > 0.0) axes = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * axes;
  return axes * Eigen::AngleAxisd(o(3), Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

double height_over(const Place& at, const Object& o, const Eigen::Vector3d& p) {
  const Eigen::Vector3d d = axes_of(at, o).transpose() * (p - at.p_m);
  const double square = d.y() * d.y() + d.z() * d.z();  // the axis is along x
  return (2.0 * d.z() + o(4) * square) / (1.0 + std::sqrt(1.0 + 2.0 * o(4) * d.z() + o(4) * o(4) * square)) - o(2);
}

Eigen::Vector3d normal_over(const Place& at, const Object& o, const Eigen::Vector3d& p) {
  const Eigen::Matrix3d axes = axes_of(at, o);
  const Eigen::Vector3d d = axes.transpose() * (p - at.p_m);
  return axes * Eigen::Vector3d(0.0, o(4) * d.y(), 1.0 + o(4) * d.z()).normalized();
}

// Levenberg and Marquardt's steps, derivatives by differences. The RMS of what is left.
double fit_object(const Place& at, const std::vector<Eigen::Vector3d>& p_m, const std::vector<double>& height_m,
                  Object& o) {
  const Object step(1e-6, 1e-6, 1e-9, 1e-6, 1e-4);
  const auto residuals = [&](const Object& x) {
    Eigen::VectorXd r(static_cast<Eigen::Index>(p_m.size()));
    for (std::size_t i = 0; i < p_m.size(); ++i)
      r(static_cast<Eigen::Index>(i)) = height_over(at, x, p_m[i]) - height_m[i];
    return r;
  };
  double damping = 1e-3;
  Eigen::VectorXd r = residuals(o);
  for (int k = 0; k < 60; ++k) {
    Eigen::MatrixXd j(r.size(), 5);
    for (Eigen::Index q = 0; q < 5; ++q) {
      Object moved = o;
      moved(q) += step(q);
      j.col(q) = (residuals(moved) - r) / step(q);
    }
    Eigen::Matrix<double, 5, 5> a = j.transpose() * j;
    a.diagonal() += damping * a.diagonal() + Object::Constant(1e-18);
    const Object next = o - a.ldlt().solve(Object(j.transpose() * r));
    const Eigen::VectorXd there = residuals(next);
    const bool better = there.allFinite() && there.squaredNorm() < r.squaredNorm();
    damping *= better ? 0.2 : 10.0;
    if (!better) continue;
    o = next;
    r = there;
  }
  return std::sqrt(r.squaredNorm() / static_cast<double>(r.size()));
}

struct LeanError {
  double lean_rad = 0.0;  // RMS over the path
  double sigma_rad = 0.0;
  double misfit_m = 0.0;
};

LeanError lean_error(const asperity::Truth& truth, const asperity::TipMotion& motion,
                     const asperity::BasePathResult& base) {
  constexpr std::size_t kPoints = 1500;
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i + 1 < truth.size(); ++i) {
    if (truth.force_N[i] > 0.05 && (truth.p_world_tip_m[i + 1] - truth.p_world_tip_m[i]).norm() > 0.0) at.push_back(i);
  }
  if (at.size() < 100) throw asperity::Error("no contact");
  std::vector<Eigen::Vector3d> p_m;
  std::vector<double> height_m;
  for (std::size_t k = 0; k < kPoints; ++k) {
    p_m.push_back(truth.p_world_tip_m[at[k * at.size() / kPoints]]);
    height_m.push_back(truth.height_m[at[k * at.size() / kPoints]]);
  }
  const Eigen::Vector3d chord = p_m.back() - p_m.front();
  const std::size_t middle = motion.size() / 2;
  LeanError best;
  best.misfit_m = 1.0;
  Place place;
  Object object = Object::Zero();
  for (const double curvature_per_m : {0.0, 8.0, 15.0, 25.0}) {
    for (const double lean_rad : {0.0, 0.4, -0.4}) {
      Place start;
      start.p_m = p_m[kPoints / 2];
      const Eigen::Vector3d along = chord.normalized();
      Eigen::Vector3d n = base.path.n_world[middle];
      n = Eigen::AngleAxisd(lean_rad, along) * (n - n.dot(along) * along).normalized();
      start.n = n;
      start.y = along;
      start.x = along.cross(n);
      Object o(0.0, 0.0, 0.0, 0.0, curvature_per_m);
      const double misfit_m = fit_object(start, p_m, height_m, o);
      if (!(misfit_m < best.misfit_m)) continue;
      best.misfit_m = misfit_m;
      place = start;
      object = o;
    }
  }
  double square = 0.0, count = 0.0;
  for (std::size_t i = 1; i + 1 < motion.size(); ++i) {
    if (base.contact[i] == 0 || !(base.speed_mps[i] > 5e-3)) continue;
    const Eigen::Vector3d t = motion.v_world_tip_mps[i].normalized();
    const Eigen::Vector3d n = normal_over(place, object, motion.p_world_tip_m[i]);
    square += std::pow(std::asin(std::clamp(base.path.n_world[i].cross(n).dot(t), -1.0, 1.0)), 2);
    count += 1.0;
  }
  best.lean_rad = std::sqrt(square / count);
  best.sigma_rad = base.normal_sigma_deg * kDegree_rad;
  return best;
}

struct Column {
  std::vector<double> lean_deg, sigma_deg, ratio;
  void add(const LeanError& e) {
    lean_deg.push_back(e.lean_rad / kDegree_rad);
    sigma_deg.push_back(e.sigma_rad / kDegree_rad);
    ratio.push_back(e.lean_rad / e.sigma_rad);
  }
  void print() const {
    double square = 0.0;
    for (const double r : ratio) square += r * r / static_cast<double>(ratio.size());
    std::printf(" %.1f | %.1f | %.1f | %.2f |", asperity::median(lean_deg), asperity::percentile(lean_deg, 90.0),
                asperity::median(sigma_deg), std::sqrt(square));
  }
};

}  // namespace

int main(int argc, char** argv) {
  try {
    int scans = 100;
    std::uint64_t seed = 1;
    bool ours = true, list = false;
    bench::CaseChoice choice;
    std::uint64_t scan_number = 0;
    bench::read_options(
        argc, argv,
        {{"--scans", [&](auto value) { scans = static_cast<int>(bench::number_within(value, 1.0, 1e6)); }},
         {"--seed", [&](auto value) { seed = static_cast<std::uint64_t>(bench::number_within(value, 0.0, 1e12)); }},
         {"--simulator", [&](auto value) { ours = bench::is_first(value, "ours", "second"); }},
         {"--scan",
          [&](auto value) { scan_number = static_cast<std::uint64_t>(bench::number_within(value, 1.0, 1e15)); }},
         {"--list", [&](auto value) { list = bench::is_first(value, "yes", "no"); }},
         {"--families", [&](auto value) { choice.families = bench::split_list(value); }},
         {"--probes", [&](auto value) { choice.probes = bench::split_list(value); }}});
    std::map<std::string, std::pair<Column, Column>> rows;
    if (scan_number > 0) scans = 1;
    for (int i = 0; i < scans; ++i) {
      const std::uint64_t number = scan_number > 0 ? scan_number : seed * 1'000'000 + static_cast<std::uint64_t>(i);
      const bench::ScanCase scan =
          ours ? bench::simulate_own_case(number, choice) : bench::simulate_second_case(number, choice);
      if (scan.family == "air" || !scan.recording.truth) continue;
      try {
        const asperity::ProcessResult with = asperity::process_recording(scan.recording, {});
        asperity::ProcessConfig config;
        config.base.texture_axis_sigma_deg = 0.0;
        const asperity::ProcessResult without = asperity::process_recording(scan.recording, config);
        const LeanError a = lean_error(*scan.recording.truth, without.trajectory.motion, without.base);
        const LeanError b = lean_error(*scan.recording.truth, with.trajectory.motion, with.base);
        if (list) {
          std::printf("%llu %s %s %s misfit %.2f um: %.1f of %.1f, %.1f of %.1f\n",
                      static_cast<unsigned long long>(number), scan.family.c_str(), scan.probe.c_str(),
                      std::string(asperity::kPathShapeNames[static_cast<std::size_t>(with.base.shape)]).c_str(),
                      1e6 * b.misfit_m, a.lean_rad / kDegree_rad, a.sigma_rad / kDegree_rad, b.lean_rad / kDegree_rad,
                      b.sigma_rad / kDegree_rad);
        }
        if (b.misfit_m > 5e-6) continue;
        for (const std::string& key : {std::string("all | both"), scan.family + " | " + scan.probe}) {
          rows[key].first.add(a);
          rows[key].second.add(b);
        }
      } catch (const asperity::Error&) {
        continue;  // without a path there is no normal
      }
    }
    std::printf(
        "| family | probe | scans | path and probe alone: lean, ° | 90 %% | σ, ° | lean/σ, RMS | all: lean, ° | "
        "90 %% | σ, ° | lean/σ, RMS |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const auto& [key, columns] : rows) {
      std::printf("| %s | %zu |", key.c_str(), columns.first.ratio.size());
      columns.first.print();
      columns.second.print();
      std::printf("\n");
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "normal_lean: %s\n", error.what());
    return 1;
  }
}
