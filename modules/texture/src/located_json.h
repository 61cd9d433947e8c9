#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "asperity/json/json.h"

namespace asperity {

// A JSON document that knows on which line each key stands, for messages.
class LocatedJson {
 public:
  using Json = asperity::Json;

  // Throws Error for text that is not one JSON object, is nested deeper than 32, or has a key twice.
  LocatedJson(std::string_view text, std::string name);

  const Json& root() const { return root_; }

  // A member of the object at `path` ("" or "fourier1d"); nullptr if it is not there.
  const Json* find(const std::string& path, const char* key) const;
  const Json& require(const std::string& path, const char* key) const;
  // Throws Error for a member of the object at `path` that is not one of `known`.
  void only(const std::string& path, std::initializer_list<std::string_view> known) const;

  // "file:line: 'path': message", the line of the nearest key that encloses `path`.
  [[noreturn]] void fail(const std::string& path, const std::string& message) const;

 private:
  const Json& at(const std::string& path) const;

  std::string name_;
  Json root_;
};

}  // namespace asperity
