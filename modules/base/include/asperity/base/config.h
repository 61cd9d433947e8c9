#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace asperity {

// Each stage has one config struct with defaults beside its fields and one `visit` that lists them:
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
// From this come TOML files, `--set stage.field=value`, `--print-config` and the record in results.

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

enum class FieldType { kBool, kInteger, kNumber, kText, kChoice, kNumbers };

// One field of a config, by its dotted path. Valid as long as the config it was listed from.
struct ConfigField {
  std::string path;
  FieldType type = FieldType::kNumber;
  std::string description;
  Range range;
  std::vector<std::string> choices;
  std::function<std::string()> get;           // as written in TOML
  std::function<void(std::string_view)> set;  // throws Error naming path, value and what is allowed
};

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

// Sets the field at `path`; throws Error for an unknown path, naming the nearest known one.
void set_field(const std::vector<ConfigField>& fields, std::string_view path, std::string_view value);

// The fields as TOML, a table a group, each with its description as a comment if asked.
std::string to_toml(const std::vector<ConfigField>& fields, bool with_descriptions);

}  // namespace asperity
