#include "located_json.h"

#include <algorithm>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"

namespace asperity {
namespace {

std::string joined(const std::string& path, std::string_view key) {
  std::string result = path;
  if (!result.empty()) result += '.';
  return result.append(key);
}

}  // namespace

LocatedJson::LocatedJson(std::string_view text, std::string name) : name_(std::move(name)) {
  root_ = parse_json(text, name_);
  if (!root_.is_object()) throw Error(name_ + ":1: not a JSON object");
}

const LocatedJson::Json& LocatedJson::at(const std::string& path) const {
  const Json* value = &root_;
  for (std::string_view rest = path; !rest.empty();) {
    const auto dot = rest.find('.');
    value = &value->at(rest.substr(0, dot));
    rest.remove_prefix(dot == std::string_view::npos ? rest.size() : dot + 1);
  }
  return *value;
}

const LocatedJson::Json* LocatedJson::find(const std::string& path, const char* key) const {
  const Json& object = at(path);
  if (!object.is_object()) fail(path, "is not an object");
  return object.find(key);
}

const LocatedJson::Json& LocatedJson::require(const std::string& path, const char* key) const {
  const Json* found = find(path, key);
  if (!found) fail(path, "the key '" + std::string(key) + "' is missing");
  return *found;
}

void LocatedJson::only(const std::string& path, std::initializer_list<std::string_view> known) const {
  const Json& object = at(path);
  if (!object.is_object()) fail(path, "is not an object");
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      fail(joined(path, key), "is not a key of this format; additions belong into 'extra'");
    }
  }
}

void LocatedJson::fail(const std::string& path, const std::string& message) const {
  // The path itself may be of an array's element or of a key that is missing.
  const Json* nearest = &root_;
  for (std::string_view rest = path; nearest->is_object() && !rest.empty();) {
    const auto end = rest.find_first_of(".[");
    const Json* inner = nearest->find(rest.substr(0, end));
    if (inner == nullptr) break;
    nearest = inner;
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  const std::size_t line = nearest->place().line;
  throw Error(name_ + ":" + std::to_string(line) + ": " + (path.empty() ? "" : "'" + printable(path) + "': ") +
              message);
}

}  // namespace asperity
