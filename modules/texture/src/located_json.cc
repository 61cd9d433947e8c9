#include "located_json.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {
namespace {

constexpr std::size_t kDeepestJson = 32;

// Reads bytes and counts lines on the way, so that the parser's callback knows where it is.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at = nullptr;
  std::size_t* line = nullptr;

  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    if (*at == '\n') ++*line;
    ++at;
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at == other.at; }
};

struct Level {
  std::string path;            // of the object or array
  std::string member;          // of an object: the path of its current key
  std::set<std::string> keys;  // seen so far
};

std::string joined(const std::string& path, std::string_view key) {
  std::string result = path;
  if (!result.empty()) result += '.';
  return result.append(key);
}

// The parser's own words, without its exception's name and position.
std::string reason(const nlohmann::json::exception& error) {
  std::string_view text = error.what();
  if (const auto end = text.find("] "); end != std::string_view::npos) text.remove_prefix(end + 2);
  if (text.starts_with("parse error at line")) {
    if (const auto end = text.find(": "); end != std::string_view::npos) text.remove_prefix(end + 2);
  }
  return printable(text, 200);
}

}  // namespace

LocatedJson::LocatedJson(std::string_view text, std::string name) : name_(std::move(name)) {
  std::size_t line = 1;
  const auto here = [&] { return name_ + ":" + std::to_string(line) + ": "; };
  std::vector<Level> levels;
  using Event = Json::parse_event_t;
  const auto on_event = [&](int, Event event, Json& value) {
    if (event == Event::object_start || event == Event::array_start) {
      if (levels.size() == kDeepestJson) throw Error(here() + "nested deeper than " + std::to_string(kDeepestJson));
      levels.push_back({levels.empty() ? "" : levels.back().member, "", {}});
      levels.back().member = levels.back().path;
    } else if (event == Event::object_end || event == Event::array_end) {
      levels.pop_back();
    } else if (event == Event::key) {
      const auto& key = value.get_ref<const std::string&>();
      Level& level = levels.back();
      level.member = joined(level.path, key);
      if (!level.keys.insert(key).second)
        throw Error(here() + "the key '" + printable(level.member) + "' appears twice");
      if (levels.size() <= 3) line_.emplace(level.member, line);
    }
    return true;
  };
  try {
    root_ =
        Json::parse(CountingIterator{text.data(), &line}, CountingIterator{text.data() + text.size(), &line}, on_event);
  } catch (const nlohmann::json::exception& error) {
    throw Error(here() + "not JSON: " + reason(error));
  }
  if (!root_.is_object()) throw Error(name_ + ":1: not a JSON object");
}

const LocatedJson::Json& LocatedJson::at(const std::string& path) const {
  const Json* value = &root_;
  for (std::string_view rest = path; !rest.empty();) {
    const auto dot = rest.find('.');
    value = &value->at(std::string(rest.substr(0, dot)));
    rest.remove_prefix(dot == std::string_view::npos ? rest.size() : dot + 1);
  }
  return *value;
}

const LocatedJson::Json* LocatedJson::find(const std::string& path, const char* key) const {
  const Json& object = at(path);
  if (!object.is_object()) fail(path, "is not an object");
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
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
  std::size_t line = 1;
  // The path itself may be of an array's element or of a key that is missing.
  for (std::string enclosing = path; !enclosing.empty();) {
    if (const auto found = line_.find(enclosing); found != line_.end()) {
      line = found->second;
      break;
    }
    const auto cut = enclosing.find_last_of(".[");
    enclosing.resize(cut == std::string::npos ? 0 : cut);
  }
  throw Error(name_ + ":" + std::to_string(line) + ": " + (path.empty() ? "" : "'" + printable(path) + "': ") +
              message);
}

}  // namespace asperity
