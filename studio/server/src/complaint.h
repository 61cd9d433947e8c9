#pragma once

#include <exception>
#include <optional>
#include <string>

namespace asperity::studio {

// The message of a page about work that failed, and the advice.
struct Complaint {
  std::string problem, hint;
};

// `hint` is for an error that brings none of its own. nullopt: the work was cancelled, and no message is needed.
std::optional<Complaint> complaint_of(const std::exception_ptr& error, const std::string& hint);

}  // namespace asperity::studio
