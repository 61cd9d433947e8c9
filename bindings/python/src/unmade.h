#pragma once

#include <cstddef>
#include <typeindex>

#include <pybind11/pybind11.h>

namespace asperity::python {

inline constexpr const char* kUnmade =
    "the object was not made: call its class, or the function that returns such objects";

// For each class: Class.__new__(Class), copy and pickle make a Python object without a C++ object, for which pybind11
// 2.10 would take uninitialised memory. Its use raises TypeError instead.
template <class T>
void refuse_unmade() {
  pybind11::detail::get_type_info(std::type_index(typeid(T)), true)->operator_new = [](std::size_t) -> void* {
    throw pybind11::type_error(kUnmade);
  };
}

}  // namespace asperity::python
