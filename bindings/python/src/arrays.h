#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <Eigen/Geometry>

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

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

// One dimension, any length, or a number. Throws ValueError.
inline std::span<const double> numbers_of(const Doubles& array, const char* name) {
  if (array.ndim() > 1) throw py::value_error(std::string(name) + ": an array of one dimension is wanted");
  return {array.data(), static_cast<std::size_t>(array.size())};
}

// (n, 3), as rows. Throws ValueError.
inline std::span<const Eigen::Vector3d> points_of(const Doubles& array, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw py::value_error(std::string(name) + ": an array of shape (n, 3) is wanted");
  return {reinterpret_cast<const Eigen::Vector3d*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

// The same; throws ValueError also for a row that is not finite, which has no answer.
inline std::span<const Eigen::Vector3d> finite_points_of(const Doubles& array, const char* name) {
  const std::span<const Eigen::Vector3d> rows = points_of(array, name);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].allFinite())
      throw py::value_error(std::string(name) + ": row " + std::to_string(i) + " is not finite");
  }
  return rows;
}

// (n, 3) whole numbers below `vertices`. Throws ValueError and IndexError.
inline std::vector<std::array<std::uint32_t, 3>> triangles_of(const py::object& given, std::size_t vertices) {
  const py::array array = py::array::ensure(given);
  if (!array || array.ndim() != 2 || array.shape(1) != 3)
    throw py::value_error("triangles: an array of shape (n, 3) is wanted");
  if (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')
    throw py::value_error("triangles: an array of whole numbers is wanted");
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> whole(array);
  std::vector<std::array<std::uint32_t, 3>> out(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::int64_t index = *whole.data(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(corner));
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices) {
        throw py::index_error("triangles: triangle " + std::to_string(i) + " has the vertex " + std::to_string(index) +
                              ", and there are " + std::to_string(vertices));
      }
      out[i][corner] = static_cast<std::uint32_t>(index);
    }
  }
  return out;
}

// `value` if it is from `from` to `to`. Throws ValueError.
inline double within(double value, double from, double to, const char* name) {
  if (value >= from && value <= to) return value;
  throw py::value_error(std::string(name) + " is " + std::to_string(value) + ", not from " + std::to_string(from) +
                        " to " + std::to_string(to));
}

// Three numbers. Throws ValueError.
inline Eigen::Vector3d vector_of(const Doubles& array, const char* name) {
  if (array.ndim() != 1 || array.size() != 3) throw py::value_error(std::string(name) + ": three numbers are wanted");
  return Eigen::Vector3d::Map(array.data());
}

// New arrays that C++ fills.
inline py::array_t<double> rows_of_three(std::size_t n) {
  return py::array_t<double>({static_cast<py::ssize_t>(n), py::ssize_t{3}});
}

}  // namespace asperity::python
