#pragma once

#include <string>

namespace asperity::studio {

// One result as report.html holds it: its name, and a block of kind "measured" (measured_block.h). One that was read
// from files lacks what they do not hold: base path, contact, windows of compliance, the truth, where the gaps are and
// why.
struct ReportItem {
  std::string name;
  std::string block;
};

}  // namespace asperity::studio
