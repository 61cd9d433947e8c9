#include "named_arguments.h"

#include "asperity/base/text.h"

namespace asperity::python {

namespace {

std::string type_name(py::handle given) { return py::str(py::type::handle_of(given).attr("__name__")); }

}  // namespace

std::string utf8_of(py::handle given, const char* name) {
  if (!PyUnicode_Check(given.ptr()))
    throw py::type_error(std::string(name) + ": a str is wanted, not " + type_name(given));
  Py_ssize_t length = 0;
  const char* const letters = PyUnicode_AsUTF8AndSize(given.ptr(), &length);
  if (letters == nullptr) {
    PyErr_Clear();
    throw py::value_error(std::string(name) + ": a surrogate is no character");
  }
  return {letters, static_cast<std::size_t>(length)};
}

py::dict dict_of(py::handle given, const char* name) {
  if (py::isinstance<py::dict>(given)) return py::reinterpret_borrow<py::dict>(given);
  if (!py::isinstance(given, py::module_::import("collections.abc").attr("Mapping")))
    throw py::type_error(std::string(name) + ": a dict or another mapping is wanted, not " + type_name(given));
  return py::dict(py::reinterpret_borrow<py::object>(given));
}

}  // namespace asperity::python
