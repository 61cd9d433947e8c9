#pragma once

#include <exception>
#include <optional>
#include <string>

namespace asperity::studio {

// What a page says of work that failed, and what to do about it.
struct Complaint {
  std::string problem, hint;
};

// `hint` is for an error that brings none of its own. nullopt: the work was called off, of which nothing is to be said.
std::optional<Complaint> complaint_of(const std::exception_ptr& error, const std::string& hint);

}  // namespace asperity::studio
