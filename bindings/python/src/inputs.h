#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <Eigen/Core>

#include "asperity/base/config.h"
#include "asperity/geometry/pose.h"

// Arrays and numbers that a caller passes. What is no array of real numbers is refused by name: text, complex numbers,
// objects and None, which NumPy would turn into some number.
namespace asperity::python {

namespace py = pybind11;

enum class Masked { kRefused, kMissing };  // kMissing: masked values are nan

// As an array of doubles, without a copy where it is one. Throws TypeError for another kind of values, ValueError for
// masked ones.
py::array_t<double> doubles_of(py::handle given, const char* name, Masked masked = Masked::kRefused);

// Numbers of one dimension, or a single one. Lives as long as they are read.
class Numbers {
 public:
  // Throws TypeError and ValueError.
  Numbers(py::handle given, const char* name, Masked masked = Masked::kRefused);

  std::span<const double> all() const { return {array_.data(), size()}; }
  std::size_t size() const { return static_cast<std::size_t>(array_.size()); }

 private:
  py::array_t<double> array_;
};

// Coordinates in metres. Throws ValueError also for what is not finite or beyond 1e6 m.
Numbers places_of(py::handle given, const char* name);

// Rows of an array (n, 3).
class Rows {
 public:
  // Throws TypeError and ValueError.
  Rows(py::handle given, const char* name);

  std::span<const Eigen::Vector3d> all() const {
    return {reinterpret_cast<const Eigen::Vector3d*>(array_.data()), size()};
  }
  std::size_t size() const { return static_cast<std::size_t>(array_.shape(0)); }

 private:
  py::array_t<double> array_;
};

// (n, 3) points or directions; throws ValueError also for a row that is not finite, which has no answer.
Rows finite_rows(py::handle given, const char* name);

// The same for places, which are within 1e6 m of the origin.
Rows place_rows(py::handle given, const char* name);

// Throws ValueError for vertices_m of a mesh that is smaller than 1e-9 m.
void require_mesh_size(const Rows& rows);

// Three numbers. Throws TypeError and ValueError.
Eigen::Vector3d vector_of(py::handle given, const char* name);

// (4, 4), a rotation and a translation. Throws TypeError and ValueError.
Pose pose_of_matrix(py::handle given, const char* name);

// (n, 3) whole numbers below `vertices`. Throws TypeError, ValueError and IndexError.
std::vector<std::array<std::uint32_t, 3>> triangles_of(py::handle given, std::size_t vertices);

// `value` if it is in the range. Throws ValueError.
double within(double value, const Range& range, const char* name);

// The length of a mesh's unit, m. Throws ValueError.
inline double unit_of(double unit_m, const char* name) { return within(unit_m, {1e-9, 1e3}, name); }

}  // namespace asperity::python
