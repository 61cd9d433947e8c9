#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace asperity {

// Each stage has one config struct with a default for each field and one `visit` that lists them:
//
//   struct HighPassConfig {
//     double cutoff_cycles_per_mm = 0.05;
//     Window window = Window::kHann;
//     template <class V> void visit(V& v) {
//       v.field("cutoff_cycles_per_mm", cutoff_cycles_per_mm, "-3 dB point of the whole filter", {0.0, 40.0});
//       v.choice("window", window, kWindowNames, "taper");
//       v.group("inner", inner);
//     }
//   };
//
// A field that had another name says so, and files and options that have the old one are read for ever:
//
//       v.field("min_score", min_score, "a lower score is invalid", {0.0, 1.0});
//       v.former("poor");
//
// From this come TOML files, `--set stage.field=value`, `--print-config` and the record in results.

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

enum class FieldType { kBool, kInteger, kNumber, kText, kChoice, kNumbers };

// What a field holds, in the order of FieldType; a choice is the text of its name.
using ConfigValue = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

// One field of a config, by its dotted path. Valid as long as the config it was listed from.
struct ConfigField {
  std::string path;
  std::vector<std::string> former;  // paths that it had: read as `path` is, never written
  FieldType type = FieldType::kNumber;
  std::string description;
  Range range;
  std::vector<std::string> choices;
  std::function<ConfigValue()> read;
  std::function<bool(const ConfigValue&)> write;  // false: refused, the config is as it was

  ConfigValue get() const { return read(); }
  // Throws Error naming path, value and what is allowed. A whole number is a number too, and text takes any single
  // value as TOML writes it.
  void set(const ConfigValue& value) const;
  // The same from the text of `--set`: texts and choices with or without quotes, lists with or without brackets.
  void set_text(std::string_view text) const;
};

// The value as TOML writes it.
std::string toml_text(const ConfigValue& value);

class ConfigLister {
 public:
  void field(std::string_view name, bool& value, std::string_view description);
  void field(std::string_view name, int& value, std::string_view description, Range range = {});
  void field(std::string_view name, std::int64_t& value, std::string_view description, Range range = {});
  void field(std::string_view name, double& value, std::string_view description, Range range = {});
  void field(std::string_view name, std::string& value, std::string_view description);
  void numbers(std::string_view name, double* values, std::size_t count, std::string_view description,
               Range range = {});

  template <std::size_t N>
  void field(std::string_view name, std::array<double, N>& values, std::string_view description, Range range = {}) {
    numbers(name, values.data(), N, description, range);
  }

  // An enum whose values count from 0, in the order of `names`.
  template <class Enum, std::size_t N>
  requires std::is_enum_v<Enum>
  void choice(std::string_view name, Enum& value, const std::array<std::string_view, N>& names,
              std::string_view description) {
    add_choice(
        name, {names.begin(), names.end()}, description, [&value] { return static_cast<std::size_t>(value); },
        [&value](std::size_t i) { value = static_cast<Enum>(i); });
  }

  // The field listed last was called `name` before, in the same group.
  void former(std::string_view name);

  template <class Config>
  void group(std::string_view name, Config& config) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    config.visit(*this);
    prefix_ = outer;
  }

  std::vector<ConfigField> take() { return std::move(fields_); }

 private:
  ConfigField& add(std::string_view name, FieldType type, std::string_view description, Range range);
  template <class Integer>
  void add_integer(std::string_view name, Integer& value, std::string_view description, Range range);
  void add_choice(std::string_view name, std::vector<std::string> names, std::string_view description,
                  std::function<std::size_t()> get, std::function<void(std::size_t)> set);

  std::string prefix_;
  std::vector<ConfigField> fields_;
};

// All fields of `config`, their paths beginning with `name` and a dot unless it is empty.
template <class Config>
std::vector<ConfigField> list_fields(std::string_view name, Config& config) {
  ConfigLister lister;
  if (name.empty()) {
    config.visit(lister);
  } else {
    lister.group(name, config);
  }
  return lister.take();
}

// True if all fields of both hold the same.
template <class Config>
bool is_same_config(Config a, Config b) {
  const std::vector<ConfigField> fields_a = list_fields("", a), fields_b = list_fields("", b);
  return std::equal(fields_a.begin(), fields_a.end(), fields_b.begin(), fields_b.end(),
                    [](const ConfigField& x, const ConfigField& y) { return x.get() == y.get(); });
}

// The field at `path`, or that was there formerly; throws UnknownSetting (unknown_setting.h) for another.
const ConfigField& find_field(const std::vector<ConfigField>& fields, std::string_view path);

// Sets the field at `path` from the text of `--set`.
void set_field(const std::vector<ConfigField>& fields, std::string_view path, std::string_view text);

// The fields as TOML, a table a group, each with its description as a comment if asked.
std::string to_toml(const std::vector<ConfigField>& fields, bool with_descriptions);

}  // namespace asperity
