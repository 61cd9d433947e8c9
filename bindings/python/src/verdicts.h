#pragma once

#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "asperity/verdict/verdict.h"

namespace asperity::python {

// A dict per verdict, as `verdicts` of the JSON files has them.
inline std::vector<pybind11::dict> verdicts_of(const Verdicts& verdicts) {
  std::vector<pybind11::dict> out;
  for (const Verdict& verdict : verdicts) {
    pybind11::dict one;
    one["code"] = verdict.code;
    one["severity"] = std::string(kSeverityNames[static_cast<std::size_t>(verdict.severity)]);
    one["message"] = verdict.message;
    one["remedy"] = verdict.remedy;
    out.push_back(one);
  }
  return out;
}

}  // namespace asperity::python
