#include "inputs.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "asperity/base/text.h"
#include "asperity/geometry/mesh_unit.h"

namespace asperity::python {

namespace {

bool is_plain_array(py::handle given) {
  return Py_TYPE(given.ptr()) == reinterpret_cast<PyTypeObject*>(py::detail::npy_api::get().PyArray_Type_);
}

// Throws TypeError for complex numbers, texts, objects and truth values.
void require_numbers(const py::array& array, const char* name) {
  const char kind = array.dtype().kind();
  if (kind == 'f' || kind == 'i' || kind == 'u') return;
  throw py::type_error(std::string(name) + ": real numbers are wanted, not values of the type " +
                       std::string(py::str(array.dtype())));
}

// A masked array as a plain one; anything else as it is.
py::object without_mask(py::handle given, const char* name, Masked masked) {
  if (is_plain_array(given) || !py::isinstance<py::array>(given)) return py::reinterpret_borrow<py::object>(given);
  const py::module_ ma = py::module_::import("numpy.ma");
  if (!py::isinstance(given, ma.attr("MaskedArray"))) return py::reinterpret_borrow<py::object>(given);
  if (!ma.attr("is_masked")(given).cast<bool>()) return ma.attr("getdata")(given);
  if (masked == Masked::kRefused)
    throw py::value_error(std::string(name) + ": masked values are refused; leave them out");
  require_numbers(py::reinterpret_borrow<py::array>(given), name);
  const py::object filled = given.attr("astype")("f8").attr("filled")(std::nan(""));
  return filled;
}

py::array array_of(py::handle given, const char* name, Masked masked) {
  const py::object plain = without_mask(given, name, masked);
  const py::array array = py::array::ensure(plain);
  if (!array) throw py::type_error(std::string(name) + ": an array of numbers is wanted");
  return array;
}

// [1, 2, 3] has a shape of (3,).
std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

}  // namespace

py::array_t<double> doubles_of(py::handle given, const char* name, Masked masked) {
  using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
  if (is_plain_array(given) && Doubles::check_(given)) return py::reinterpret_borrow<Doubles>(given);
  const py::array array = array_of(given, name, masked);
  require_numbers(array, name);
  return Doubles(array);
}

Numbers::Numbers(py::handle given, const char* name, Masked masked) : array_(doubles_of(given, name, masked)) {
  if (array_.ndim() > 1)
    throw py::value_error(std::string(name) + ": an array of one dimension is wanted, not of the shape " +
                          shape_text(array_));
}

Numbers places_of(py::handle given, const char* name) {
  Numbers numbers(given, name);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!(std::abs(numbers.all()[i]) <= kFurthestPlace_m)) {
      throw py::value_error(std::string(name) + ": value " + std::to_string(i) + " is " +
                            number_text(numbers.all()[i]) + ", not within " + number_text(kFurthestPlace_m) + " m");
    }
  }
  return numbers;
}

Rows::Rows(py::handle given, const char* name) : array_(doubles_of(given, name)) {
  if (array_.ndim() != 2 || array_.shape(1) != 3)
    throw py::value_error(std::string(name) + ": an array of shape (n, 3) is wanted, not " + shape_text(array_));
}

Rows finite_rows(py::handle given, const char* name) {
  Rows rows(given, name);
  const std::span<const Eigen::Vector3d> all = rows.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].allFinite()) throw py::value_error(std::string(name) + ": row " + std::to_string(i) + " is not finite");
  }
  return rows;
}

Rows place_rows(py::handle given, const char* name) {
  Rows rows = finite_rows(given, name);
  const std::span<const Eigen::Vector3d> all = rows.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].cwiseAbs().maxCoeff() > kFurthestPlace_m) {
      throw py::value_error(std::string(name) + ": row " + std::to_string(i) + " is beyond " +
                            number_text(kFurthestPlace_m) + " m");
    }
  }
  return rows;
}

void require_mesh_size(const Rows& rows) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : rows.all()) box.extend(vertex);
  if (!box.isEmpty() && box.diagonal().norm() < kSmallestMesh_m) {
    throw py::value_error("vertices_m: a mesh of " + number_text(box.diagonal().norm()) +
                          " m is not plausible: at least " + number_text(kSmallestMesh_m) + " m");
  }
}

Eigen::Vector3d vector_of(py::handle given, const char* name) {
  const py::array_t<double> array = doubles_of(given, name);
  if (array.ndim() != 1 || array.size() != 3) throw py::value_error(std::string(name) + ": three numbers are wanted");
  return Eigen::Vector3d::Map(array.data());
}

Pose pose_of_matrix(py::handle given, const char* name) {
  const py::array_t<double> array = doubles_of(given, name);
  if (array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4)
    throw py::value_error(std::string(name) + ": an array of shape (4, 4) is wanted, not " + shape_text(array));
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> m =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(array.data());
  constexpr double kRounded = 1e-6;  // as a matrix of six digits has it
  const Eigen::Matrix3d rotation = m.topLeftCorner<3, 3>();
  if (m.topRightCorner<3, 1>().cwiseAbs().maxCoeff() > kFurthestPlace_m)
    throw py::value_error(std::string(name) + ": a translation beyond " + number_text(kFurthestPlace_m) + " m");
  const bool is_rotation = m.allFinite() && (rotation * rotation.transpose()).isIdentity(kRounded) &&
                           rotation.determinant() > 0.0 &&
                           m.row(3).isApprox(Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0), kRounded);
  if (!is_rotation)
    throw py::value_error(std::string(name) + ": a rotation and a translation are wanted, the last row 0, 0, 0, 1");
  return {Eigen::Quaterniond(rotation).normalized(), m.topRightCorner<3, 1>()};
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(py::handle given, std::size_t vertices) {
  const py::array array = array_of(given, "triangles", Masked::kRefused);
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw py::value_error("triangles: an array of shape (n, 3) is wanted, not " + shape_text(array));
  if (array.dtype().kind() != 'i' && array.dtype().kind() != 'u')
    throw py::value_error("triangles: an array of whole numbers is wanted");
  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast> whole(array);
  std::vector<std::array<std::uint32_t, 3>> out(static_cast<std::size_t>(array.shape(0)));
  const std::int64_t* at = whole.data();
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::int64_t index = *at++;
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices) {
        throw py::index_error("triangles: triangle " + std::to_string(i) + " has the vertex " + std::to_string(index) +
                              ", and there are " + std::to_string(vertices));
      }
      out[i][corner] = static_cast<std::uint32_t>(index);
    }
  }
  return out;
}

double within(double value, const Range& range, const char* name) {
  if (value >= range.low && value <= range.high) return value;
  throw py::value_error(std::string(name) + " is " + number_text(value) + ", not from " + number_text(range.low) +
                        " to " + number_text(range.high));
}

}  // namespace asperity::python
