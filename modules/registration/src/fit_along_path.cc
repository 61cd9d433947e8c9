#include "fit_along_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "asperity/geometry/mesh_point.h"

namespace asperity {

using Eigen::Vector2d;
using Eigen::Vector3d;

void fit_along_path(const TriangleMesh& mesh, std::span<const PathPiece> pieces, double edge_m, double smoothness,
                    std::span<const std::uint32_t> chosen, const std::vector<bool>& shared,
                    std::vector<HapticTriangle>& triangles) {
  std::unordered_map<std::uint32_t, int> unknown;  // by vertex
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<bool> takes_part(mesh.triangles.size(), false);
  for (const std::uint32_t t : chosen) {
    if (!shared[t]) continue;
    takes_part[t] = true;
    for (const std::uint32_t v : mesh.triangles[t]) unknown.try_emplace(v, static_cast<int>(unknown.size()));
    for (std::size_t e = 0; e < 3; ++e) {
      const int a = unknown.at(mesh.triangles[t][e]);
      const int b = unknown.at(mesh.triangles[t][(e + 1) % 3]);
      entries.insert(entries.end(), {{a, a, smoothness}, {b, b, smoothness}, {a, b, -smoothness}, {b, a, -smoothness}});
    }
  }
  if (unknown.empty()) return;
  const auto count = static_cast<int>(unknown.size());
  // Where the path gives no hold, the correction is none.
  for (int i = 0; i < count; ++i) entries.emplace_back(i, i, 1e-6 * smoothness);

  Eigen::Matrix<double, Eigen::Dynamic, 2> right = Eigen::MatrixX2d::Zero(count, 2);
  for (const PathPiece& piece : pieces) {
    if (!takes_part[piece.triangle]) continue;
    const double length_m =
        (position_m(mesh, {piece.triangle, piece.to}) - position_m(mesh, {piece.triangle, piece.from})).norm();
    const auto samples = static_cast<int>(std::clamp(std::ceil(4.0 * length_m / edge_m), 1.0, 1e4));
    const double weight = length_m / edge_m / samples;
    for (int k = 0; k < samples; ++k) {
      const double u = (k + 0.5) / samples;
      const Vector3d w = (1.0 - u) * piece.from + u * piece.to;
      const Vector2d wanted_mm(1e3 * (piece.from_s_m + u * (piece.to_s_m - piece.from_s_m)), 0.0);
      const HapticTriangle& h = triangles[piece.triangle];
      const Vector2d missing_mm = wanted_mm - (w[0] * h.xy_mm[0] + w[1] * h.xy_mm[1] + w[2] * h.xy_mm[2]);
      for (Eigen::Index i = 0; i < 3; ++i) {
        const int row = unknown.at(mesh.triangles[piece.triangle][static_cast<std::size_t>(i)]);
        right.row(row) += weight * w[i] * missing_mm.transpose();
        for (Eigen::Index j = 0; j < 3; ++j)
          entries.emplace_back(row, unknown.at(mesh.triangles[piece.triangle][static_cast<std::size_t>(j)]),
                               weight * w[i] * w[j]);
      }
    }
  }
  Eigen::SparseMatrix<double> normal(count, count);
  normal.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
  if (solver.info() != Eigen::Success) return;
  const Eigen::MatrixX2d correction = solver.solve(right);
  if (!correction.allFinite()) return;
  for (const std::uint32_t t : chosen) {
    if (!takes_part[t]) continue;
    for (std::size_t k = 0; k < 3; ++k)
      triangles[t].xy_mm[k] += correction.row(unknown.at(mesh.triangles[t][k])).transpose();
  }
}

}  // namespace asperity
