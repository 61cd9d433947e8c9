#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <Eigen/Geometry>

#include "asperity/geometry/pose.h"

// NumPy arrays of what C++ holds.
namespace asperity::python {

namespace py = pybind11;

// Read-only, without a copy: `owner` lives as long as the array.
inline py::array read_only(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

template <class Number>
py::array view(const std::vector<Number>& values, py::handle owner) {
  return read_only(py::array_t<Number>(static_cast<py::ssize_t>(values.size()), values.data(), owner));
}

// (n, 3)
inline py::array view(const std::vector<Eigen::Vector3d>& rows, py::handle owner) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  const double* first = rows.empty() ? nullptr : rows.front().data();
  return read_only(py::array_t<double>({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}}, first, owner));
}

// (n, 4): x, y, z, w, as they are in memory and as SciPy has them.
inline py::array view(const std::vector<Eigen::Quaterniond>& rows, py::handle owner) {
  static_assert(sizeof(Eigen::Quaterniond) == 4 * sizeof(double));
  const double* first = rows.empty() ? nullptr : rows.front().coeffs().data();
  return read_only(py::array_t<double>({static_cast<py::ssize_t>(rows.size()), py::ssize_t{4}}, first, owner));
}

// (n, 3) indices of corners.
inline py::array view(const std::vector<std::array<std::uint32_t, 3>>& rows, py::handle owner) {
  static_assert(sizeof(std::array<std::uint32_t, 3>) == 3 * sizeof(std::uint32_t));
  const std::uint32_t* first = rows.empty() ? nullptr : rows.front().data();
  return read_only(py::array_t<std::uint32_t>({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}}, first, owner));
}

// A pose as a row-major matrix (4, 4); a copy.
inline py::array_t<double> matrix_of(const Pose& pose) {
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> m = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>::Identity();
  m.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  m.topRightCorner<3, 1>() = pose.translation_m;
  return py::array_t<double>({py::ssize_t{4}, py::ssize_t{4}}, m.data());
}

// New arrays that C++ fills.
inline py::array_t<double> rows_of_three(std::size_t n) {
  return py::array_t<double>({static_cast<py::ssize_t>(n), py::ssize_t{3}});
}

template <class Number = double>
py::array_t<Number> column_of(std::size_t n) {
  return py::array_t<Number>(static_cast<py::ssize_t>(n));
}

// What C++ has made, without a copy: the array owns it.
inline py::array_t<double> owned(std::vector<double> values) {
  auto* const kept = new std::vector<double>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<double>*>(p); });
  return py::array_t<double>(static_cast<py::ssize_t>(kept->size()), kept->data(), owner);
}

}  // namespace asperity::python
