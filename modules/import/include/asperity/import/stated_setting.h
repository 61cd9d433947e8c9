#pragma once

#include <functional>
#include <string>
#include <utility>

#include "asperity/base/error.h"

namespace asperity {

// A setting of MappingConfig that a message says to state, such as mapping.imu_axes = y,-x,z.
struct StatedSetting {
  std::string path, value;

  bool operator==(const StatedSetting&) const = default;
};

// How the reader states one: an option here, an argument there.
using SettingText = std::function<std::string(const StatedSetting&)>;

// As `asperity import` takes it: "--imu-axes y,-x,z", "--invert-rotation", "no --invert-rotation".
std::string as_option(const StatedSetting& setting);

// A setting that cannot be guessed is missing. The message ends before how it is stated, which the caller knows.
class UnstatedSetting : public Error {
 public:
  UnstatedSetting(const std::string& text, StatedSetting example) : Error(text), example_(std::move(example)) {}
  const StatedSetting& example() const { return example_; }

 private:
  StatedSetting example_;
};

}  // namespace asperity
