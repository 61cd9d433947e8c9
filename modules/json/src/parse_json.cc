#include "asperity/json/parse_json.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "json_members.h"

namespace asperity {

namespace {

constexpr std::size_t kValuesBetweenUpdates = 4096;

// Hands the text to nlohmann's lexer byte by byte and tells how far that has come.
struct Cursor {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  const char** reached;

  reference operator*() const { return *at; }
  Cursor& operator++() {
    *reached = ++at;
    return *this;
  }
  Cursor operator++(int) {
    const Cursor before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Cursor& other) const { return at == other.at; }
};

bool is_of_number(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.' || c == 'e' || c == 'E'; }

// The reason in nlohmann's "[json.exception…] parse error at line 1, column 2: syntax error … - reason".
std::string reason_of(const nlohmann::detail::exception& error) {
  std::string_view what = error.what();
  const auto cut = [&](std::string_view mark) {
    const auto at = what.find(mark);
    if (at != std::string_view::npos) what.remove_prefix(at + mark.size());
  };
  cut("] ");
  if (what.starts_with("parse error at line")) cut(": ");
  return printable(what, 200);
}

}  // namespace

// Builds the tree from the events of nlohmann's parser. An event comes when its token has been read; where that began
// is found by going back over the token, and the line by counting on from the last one: each byte is looked at three
// times at most.
class JsonTreeBuilder {
 public:
  using Base = nlohmann::json;

  JsonTreeBuilder(std::string_view text, const std::string& name, const JsonLimits& limits, const Observer& observer)
      : begin_(text.data()),
        end_(text.data() + text.size()),
        reached_(begin_),
        name_(name),
        limits_(limits),
        observer_(observer),
        counted_(begin_),
        line_begin_(begin_) {}

  Json build() {
    Base::sax_parse(Cursor{begin_, &reached_}, Cursor{end_, &reached_}, this);
    return std::move(root_);
  }

  JsonWork work() const {
    return {work_.bytes + static_cast<std::uint64_t>(reached_ - begin_), work_.values, work_.comparisons};
  }

  bool null() { return put(Json(), go_back(4)); }
  bool boolean(bool value) { return put(Json(value), go_back(value ? 4 : 5)); }
  bool number_integer(std::int64_t value) { return put(Json(value), number_begin()); }
  bool number_unsigned(std::uint64_t value) { return put(Json(value), number_begin()); }
  bool number_float(double value, const std::string&) { return put(Json(value), number_begin()); }
  bool string(std::string& value) { return put(Json(std::move(value)), text_begin()); }
  bool binary(Base::binary_t&) { return false; }  // JSON has none

  bool start_object(std::size_t) { return open(Json::object()); }
  bool end_object() {
    open_.back()->members_->comparisons = nullptr;
    open_.pop_back();
    return true;
  }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_array() {
    open_.pop_back();
    return true;
  }

  bool key(std::string& key) {
    JsonMembers& members = *open_.back()->members_;
    const JsonPlace place = place_of(text_begin());
    if (members.find(key) != JsonMembers::kNone) {
      const std::string path = path_of_innermost();
      fail(place, fmt::format("key '{}' appears twice", printable(path.empty() ? key : path + "." + key, 200)));
    }
    if (members.list.size() >= limits_.keys) {
      fail_inside(place, fmt::format("an object with more than {} keys", limits_.keys));
    }
    // cppcheck-suppress accessMoved
    members.append(std::move(key)).set_place(place);
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) {
    const JsonPlace place = place_of(reached_ > begin_ ? reached_ - 1 : begin_);
    constexpr int kNumberOverflow = 406;
    if (std::string_view(error.what()).find("UTF-8") != std::string_view::npos) {
      const char* line_end = std::find(line_begin_, end_, '\n');
      fail_inside(place,
                  "not UTF-8 text: " + printable({line_begin_, static_cast<std::size_t>(line_end - line_begin_)}));
    }
    fail_inside(place, (error.id == kNumberOverflow ? "not usable JSON: " : "not JSON: ") + reason_of(error));
  }

 private:
  [[noreturn]] void fail(JsonPlace place, const std::string& message) const {
    throw Error(fmt::format("{}:{}:{}: {}", name_, place.line, place.column, message));
  }
  [[noreturn]] void fail_inside(JsonPlace place, const std::string& message) const {
    const std::string path = path_of_innermost();
    fail(place, path.empty() ? message : fmt::format("{} (in '{}')", message, printable(path, 200)));
  }

  // "a.b[3]" for the innermost list or object: each but the first is the last of the one around it.
  std::string path_of_innermost() const {
    std::string out;
    for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
      const Json& outer = *open_[i];
      if (outer.is_array()) {
        out += fmt::format("[{}]", outer.size() - 1);
      } else {
        out += (out.empty() ? "" : ".") + outer.items().back().key;
      }
    }
    return out;
  }

  const char* go_back(std::ptrdiff_t bytes) const { return reached_ - bytes; }
  // A number is known to be at its end when the next byte has been read.
  const char* number_begin() {
    const char* at = reached_;
    if (at > begin_ && !is_of_number(at[-1])) --at;
    const char* const number_end = at;
    while (at > begin_ && is_of_number(at[-1])) --at;
    work_.bytes += static_cast<std::uint64_t>(number_end - at);
    return at;
  }
  // Quotes inside a text have a backslash before them, the one that opens it has none.
  const char* text_begin() {
    const char* at = reached_ - 2;
    while (at > begin_ && !(*at == '"' && at[-1] != '\\')) --at;
    work_.bytes += static_cast<std::uint64_t>(reached_ - at);
    return at;
  }
  JsonPlace place_of(const char* at) {
    if (at < counted_) at = counted_;
    for (; counted_ < at; ++counted_) {
      ++work_.bytes;
      if (*counted_ != '\n') continue;
      ++line_;
      line_begin_ = counted_ + 1;
    }
    return {line_, static_cast<std::size_t>(at - line_begin_) + 1};
  }

  Json& attach(Json value, const char* begin) {
    const JsonPlace place = place_of(begin);
    if (++work_.values > limits_.values) fail_inside(place, fmt::format("more than {} values", limits_.values));
    if (work_.values % kValuesBetweenUpdates == 0) {
      observer_.update("read", static_cast<double>(reached_ - begin_) / static_cast<double>(end_ - begin_));
    }
    value.set_place(place);
    if (open_.empty()) {
      root_ = std::move(value);
      return root_;
    }
    Json& outer = *open_.back();
    if (outer.is_object()) {
      Json& member = outer.members_->list.back().value;
      member = std::move(value);
      return member;
    }
    outer.list_->push_back(std::move(value));
    return outer.list_->back();
  }
  bool put(Json value, const char* begin) {
    attach(std::move(value), begin);
    return true;
  }
  bool open(Json value) {
    if (open_.size() >= limits_.depth) {
      fail_inside(place_of(go_back(1)), fmt::format("nested more than {} deep", limits_.depth));
    }
    const bool is_object = value.is_object();
    Json& opened = attach(std::move(value), go_back(1));
    if (is_object) opened.members_->comparisons = &work_.comparisons;
    open_.push_back(&opened);
    return true;
  }

  const char* begin_;
  const char* end_;
  const char* reached_;
  const std::string& name_;
  const JsonLimits& limits_;
  const Observer& observer_;
  const char* counted_;  // up to here lines have been counted
  const char* line_begin_;
  std::size_t line_ = 1;
  JsonWork work_;
  Json root_;
  // The lists and objects that are open. Each is the last of the one before it, which does not grow while it is open.
  std::vector<Json*> open_;
};

Json parse_json(std::string_view text, const std::string& name, const JsonLimits& limits, const Observer& observer,
                JsonWork* work) {
  if (text.size() > limits.bytes) {
    throw Error(fmt::format("{}: {} bytes of JSON, more than {}", name, text.size(), limits.bytes));
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  JsonTreeBuilder builder(text, name, limits, observer);
  Json out = builder.build();
  if (work != nullptr) *work = builder.work();
  return out;
}

Json parse_json_or_null(std::string_view text, const JsonLimits& limits) {
  try {
    return parse_json(text, "JSON", limits);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace asperity
