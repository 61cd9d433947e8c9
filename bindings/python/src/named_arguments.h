#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

// Arguments that know their names, so that what is refused is named: pybind11 takes bytes for a std::string, and lists
// the whole signature for what is no dict.
namespace asperity::python {

namespace py = pybind11;

// A name as a parameter of a template.
template <std::size_t N>
struct Literal {
  constexpr Literal(const char (&text)[N]) {  // NOLINT(google-explicit-constructor): it stands for the text
    for (std::size_t i = 0; i < N; ++i) letters[i] = text[i];
  }
  char letters[N]{};
};

// A str. Throws TypeError for another type, bytes too, and ValueError for what UTF-8 does not have.
template <Literal kName>
struct Text {
  std::string of;
};

// Any mapping as a dict. Throws TypeError for another type.
template <Literal kName>
struct MappingArgument {
  py::dict of;
};

using Settings = MappingArgument<"settings">;

std::string utf8_of(py::handle given, const char* name);
py::dict dict_of(py::handle given, const char* name);

}  // namespace asperity::python

namespace pybind11::detail {

template <asperity::python::Literal kName>
struct type_caster<asperity::python::Text<kName>> {
  PYBIND11_TYPE_CASTER(asperity::python::Text<kName>, const_name("str"));
  bool load(handle given, bool /*convert*/) {
    value.of = asperity::python::utf8_of(given, kName.letters);
    return true;
  }
};

template <asperity::python::Literal kName>
struct type_caster<asperity::python::MappingArgument<kName>> {
  PYBIND11_TYPE_CASTER(asperity::python::MappingArgument<kName>, const_name("Mapping"));
  bool load(handle given, bool /*convert*/) {
    value.of = asperity::python::dict_of(given, kName.letters);
    return true;
  }
};

}  // namespace pybind11::detail
