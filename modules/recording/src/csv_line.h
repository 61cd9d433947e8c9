#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "asperity/base/text.h"

namespace asperity {

inline void append_time(std::string& out, std::int64_t t_ns) { append_number(out, t_ns); }

// The next cell of a line, empty for nan.
inline void append_cell(std::string& out, double value) {
  out += ',';
  if (!std::isnan(value)) append_exact(out, value);
}

inline void append_cells(std::string& out, const Eigen::Vector3d& values) {
  for (const double value : values) append_cell(out, value);
}

inline void append_cells(std::string& out, const Eigen::Quaterniond& q) {
  for (const double value : {q.w(), q.x(), q.y(), q.z()}) append_cell(out, value);
}

}  // namespace asperity
