#pragma once

#include <functional>
#include <string>

#include "asperity/base/error.h"
#include "asperity/geometry/read_obj.h"

namespace asperity::test {

inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

template <class Number>
void append_value(std::string& out, Number value, bool big) {
  std::string bytes(reinterpret_cast<const char*>(&value),
                    sizeof value);  // the machines we build for are little-endian
  if (big) bytes.assign(bytes.rbegin(), bytes.rend());
  out += bytes;
}

inline MeshFile pyramid() {
  return parse_obj(
      "v 0.1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0.3333333333333333\n"
      "f 4 3 2\nf 4 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n",
      "pyramid");
}

}  // namespace asperity::test
