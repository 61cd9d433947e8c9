#include <exception>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include "asperity/base/config.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/geometry/mesh_unit.h"
#include "asperity/import/stated_setting.h"
#include "parts.h"
#include "unmade.h"

namespace asperity::python {

namespace {

PyObject* error_type = nullptr;  // asperity.Error, the module's as long as the process

// Of a path whose bytes are no UTF-8, too: they are shown as Python shows them.
void raise_error(const std::string& text) {
  const auto message = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
  PyErr_SetObject(error_type, message.ptr());
}

std::string unit_hint(const UnlikelyMetres& error) {
  if (error.size_m() < 1.0) return ": state the mesh's unit in metres (unit_m, or mesh_unit_m), 1 if that is right";
  return fmt::format(
      ": state the mesh's unit in metres (unit_m, or mesh_unit_m): 1e-3 makes it {:.3g} mm, 1 if a metre is right",
      error.size_m());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const UnknownSetting& error) {
    raise_error(std::string(error.what()) + (error.suggests() ? "" : "; asperity.settings() lists them all"));
  } catch (const UnlikelyMetres& error) {
    raise_error(error.what() + unit_hint(error));
  } catch (const UnstatedSetting& error) {
    raise_error(std::string(error.what()) + ", as " + as_argument(error.example()));
  } catch (const Error& error) {
    raise_error(error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    raise_error(printable(error.path1().string(), 200) + ": " + error.code().message());
  } catch (const py::cast_error&) {  // where an object's owner is wanted; of pybind11, before it is its RuntimeError
    PyErr_SetString(PyExc_TypeError, kUnmade);
  }
}

}  // namespace

void add_errors(py::module_& module) {
  const py::exception<Error> error(module, "Error", PyExc_ValueError);
  error.attr("__doc__") = "What was given cannot be used; the text says what, where and why.";
  error_type = py::object(error).release().ptr();
  py::register_exception_translator(&translate);
}

}  // namespace asperity::python
