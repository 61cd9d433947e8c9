#include "json_pointer.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity::studio {

namespace {

// Digits without a leading zero.
std::optional<std::size_t> index_of(std::string_view step) {
  std::size_t index = 0;
  const auto [end, fault] = std::from_chars(step.data(), step.data() + step.size(), index);
  const bool whole = fault == std::errc{} && end == step.data() + step.size();
  if (!whole || (step.size() > 1 && step.front() == '0')) return std::nullopt;
  return index;
}

std::string unescaped(std::string_view step) {
  std::string out;
  for (std::size_t i = 0; i < step.size(); ++i) {
    if (step[i] != '~') {
      out += step[i];
      continue;
    }
    ++i;
    if (i == step.size() || (step[i] != '0' && step[i] != '1')) {
      throw Error("'" + printable(step) + "' is not a position in the document");
    }
    out += step[i] == '0' ? '~' : '/';
  }
  return out;
}

}  // namespace

JsonPointer parse_json_pointer(std::string_view path) {
  if (!path.empty() && path.front() != '/') throw Error("'" + printable(path) + "' is not a position in the document");
  JsonPointer out;
  while (!path.empty()) {
    path.remove_prefix(1);
    const std::size_t end = std::min(path.find('/'), path.size());
    out.push_back(unescaped(path.substr(0, end)));
    path.remove_prefix(end);
  }
  return out;
}

std::string format_json_pointer(JsonSteps pointer) {
  std::string out;
  for (const std::string& step : pointer) {
    out += '/';
    for (const char c : step) {
      if (c == '~') {
        out += "~0";
      } else if (c == '/') {
        out += "~1";
      } else {
        out += c;
      }
    }
  }
  return out;
}

const Json* find_at(const Json& tree, JsonSteps pointer) {
  const Json* at = &tree;
  for (const std::string& step : pointer) {
    if (at->is_array()) {
      const auto index = index_of(step);
      at = index && *index < at->size() ? &at->at(*index) : nullptr;
    } else {
      at = at->find(step);
    }
    if (at == nullptr) return nullptr;
  }
  return at;
}

bool set_at(Json& tree, JsonSteps pointer, const Json& value) {
  const std::string& last = pointer.back();
  Json* parent = find_at(tree, pointer.first(pointer.size() - 1));
  if (parent == nullptr) return false;
  if (parent->is_object()) {
    if (value.is_null()) {
      parent->erase(last);
    } else {
      (*parent)[last] = value;
    }
    return true;
  }
  if (!parent->is_array()) return false;
  const std::size_t size = parent->size();
  const std::size_t index = last == "-" ? size : index_of(last).value_or(size + 1);
  if (index > size || (index == size && value.is_null())) return false;
  if (value.is_null()) {
    parent->erase_at(index);
  } else if (index == size) {
    parent->push_back(value);
  } else {
    (*parent)[index] = value;
  }
  return true;
}

}  // namespace asperity::studio
