#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"
#include "json_text.h"

namespace asperity {

void append_json_text(std::string& out, std::string_view text, bool repair) {
  const auto plain = [](char c) { return c >= 0x20 && c < 0x7F && c != '"' && c != '\\'; };
  if (std::all_of(text.begin(), text.end(), plain)) {
    out += '"';
    out += text;
    out += '"';
    return;
  }
  if (!repair && !is_utf8(text)) throw Error("'" + printable(text) + "' is not UTF-8 text");
  using Escaper = nlohmann::json;
  out += Escaper(text).dump(-1, ' ', false, Escaper::error_handler_t::replace);
}

namespace {

void append_double(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  char buffer[64];
  out.append(buffer, nlohmann::detail::to_chars(buffer, buffer + sizeof buffer, value));
}

class TextOfTree {
 public:
  TextOfTree(int indent, bool repair) : indent_(indent), repair_(repair) {}

  void append(const Json& value) {
    if (value.is_object()) {
      append_all('{', '}', value.items(), [this](const JsonMember& member) {
        append_json_text(out_, member.key, repair_);
        out_ += indent_ < 0 ? ":" : ": ";
        append(member.value);
      });
    } else if (value.is_array()) {
      append_all('[', ']', value.list(), [this](const Json& element) { append(element); });
    } else {
      append_leaf(value);
    }
  }
  std::string take() { return std::move(out_); }

 private:
  template <class All, class Each>
  void append_all(char open, char close, const All& all, Each&& each) {
    out_ += open;
    ++depth_;
    bool first = true;
    for (const auto& one : all) {
      if (!first) out_ += ',';
      first = false;
      begin_line();
      each(one);
    }
    --depth_;
    if (!first) begin_line();
    out_ += close;
  }
  void begin_line() {
    if (indent_ < 0) return;
    out_ += '\n';
    out_.append(static_cast<std::size_t>(indent_) * depth_, ' ');
  }
  void append_leaf(const Json& value) {
    if (value.is_string()) {
      append_json_text(out_, value.text(), repair_);
    } else if (value.is_boolean()) {
      out_ += value.get<bool>() ? "true" : "false";
    } else if (value.is_number_unsigned()) {
      out_ += std::to_string(value.get<std::uint64_t>());
    } else if (value.is_number_integer()) {
      out_ += std::to_string(value.get<std::int64_t>());
    } else if (value.is_number()) {
      append_double(out_, value.get<double>());
    } else {
      out_ += "null";
    }
  }

  int indent_;
  bool repair_;
  std::size_t depth_ = 0;
  std::string out_;
};

std::string text_of_tree(const Json& value, int indent, bool repair) {
  TextOfTree out(indent, repair);
  out.append(value);
  return out.take();
}

}  // namespace

std::string Json::dump(int indent) const { return text_of_tree(*this, indent, false); }
std::string Json::dump_sorted() const {
  Json copy = *this;
  copy.sort_keys();
  return copy.dump();
}
std::string Json::dump_repaired(int indent) const { return text_of_tree(*this, indent, true); }

}  // namespace asperity
