#pragma once

#include <cstddef>
#include <string>
#include <typeindex>

#include <pybind11/pybind11.h>

namespace asperity::python {

inline constexpr const char* kUnmade =
    "the object was not made: call its class, or the function that returns such objects";

// For each class: Class.__new__(Class), copy and pickle make a Python object without a C++ object, for which pybind11
// 2.10 would take uninitialised memory. Its use raises TypeError instead.
template <class T>
void refuse_unmade() {
  namespace py = pybind11;
  py::detail::get_type_info(std::type_index(typeid(T)), true)->operator_new = [](std::size_t) -> void* {
    throw py::type_error(kUnmade);
  };
  // Protocols 0 and 1 would make an object of pybind11's own base class, which ends the process.
  const py::object type = py::type::of<T>();
  const auto refuse = [](const py::object& self, const py::args&) -> py::object {
    throw py::type_error("a " + std::string(py::str(py::type::of(self).attr("__name__"))) +
                         " cannot be pickled or copied: " + kUnmade);
  };
  for (const char* name : {"__reduce_ex__", "__reduce__"})
    py::setattr(type, name, py::cpp_function(refuse, py::name(name), py::is_method(type)));
}

}  // namespace asperity::python
