#pragma once

namespace asperity::bvh {

// The point of a triangle nearest to p: its weights on the corners (each within 0 and 1, sum 1) and the
// squared distance.
struct NearestOnTriangle {
  double distance2;
  double weight[3];
};

// The nearest point of the triangle abc to p, in double. The corners must be given in ascending
// lexicographic order of their coordinates: triangles that share a corner or an edge then give bit for
// bit the same squared distance to it, which is what makes the rule for ties exact.
//
// The three edges are projected on first; each is a segment, so a triangle without area needs no case of
// its own. Only if the nearest foot f lies within an edge e can the projection of p be inside. Then, with
// u the part of the opposite corner's offset that is perpendicular to e, the projection is f + s u,
// s = (p - f)·u / u·u. Starting from the foot instead of a corner bounds the error by a few roundings of
// the longest edge and of the distance, however thin the triangle: an error of the direction of u, which
// grows as length / width, moves the point by no more than the width. Every candidate is a point of the
// triangle, so the distance is never too small by more than rounding.
//
// Isa: a type that names the instruction set of the file that is compiled, so that the linker keeps apart what
// is compiled for each. Without fused operations all of them give the same bits.
template <class Isa>
NearestOnTriangle nearest_on_triangle(const double* a, const double* b, const double* c, const double* p) {
  const double* const from[3] = {a, b, a};
  const double* const to[3] = {b, c, c};
  const double* const opposite[3] = {c, a, b};
  constexpr int kFrom[3] = {0, 1, 0};
  constexpr int kTo[3] = {1, 2, 2};
  constexpr int kOpposite[3] = {2, 0, 1};

  int best = 0;
  double best2 = 0.0;
  double t = 0.0, length2 = 0.0;
  double e[3], r[3];
  for (int i = 0; i < 3; ++i) {
    double edge[3], q[3];
    for (int k = 0; k < 3; ++k) {
      edge[k] = to[i][k] - from[i][k];
      q[k] = p[k] - from[i][k];
    }
    const double ee = edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2];
    const double along = q[0] * edge[0] + q[1] * edge[1] + q[2] * edge[2];
    double s = 0.0;
    if (along > 0.0) {
      s = along >= ee ? 1.0 : along / ee;
      for (int k = 0; k < 3; ++k) q[k] = s == 1.0 ? p[k] - to[i][k] : q[k] - s * edge[k];
    }
    const double d2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    if (i == 0 || d2 < best2) {
      best = i;
      best2 = d2;
      t = s;
      length2 = ee;
      for (int k = 0; k < 3; ++k) {
        e[k] = edge[k];
        r[k] = q[k];
      }
    }
  }

  NearestOnTriangle out{best2, {0.0, 0.0, 0.0}};
  out.weight[kFrom[best]] = 1.0 - t;
  out.weight[kTo[best]] = t;
  if (t <= 0.0 || t >= 1.0) return out;

  double u[3];
  for (int k = 0; k < 3; ++k) u[k] = opposite[best][k] - from[best][k];
  const double along = (u[0] * e[0] + u[1] * e[1] + u[2] * e[2]) / length2;
  for (int k = 0; k < 3; ++k) u[k] -= along * e[k];
  const double uu = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
  const double ru = r[0] * u[0] + r[1] * u[1] + r[2] * u[2];
  if (!(ru > 0.0 && ru < uu)) return out;
  const double s = ru / uu;
  const double on_edge = t - s * along;  // (1 - s) times where the line from the corner meets the edge
  if (!(on_edge >= 0.0 && on_edge <= 1.0 - s)) return out;
  for (int k = 0; k < 3; ++k) r[k] -= s * u[k];
  const double d2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  if (d2 >= best2) return out;
  out.distance2 = d2;
  out.weight[kOpposite[best]] = s;
  out.weight[kTo[best]] = on_edge;
  out.weight[kFrom[best]] = 1.0 - s - on_edge;
  return out;
}

}  // namespace asperity::bvh
