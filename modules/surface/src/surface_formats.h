#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/surface/parse_surface_file.h"

namespace asperity {

bool is_gsf(std::string_view bytes);
SurfaceFile parse_gsf(std::string_view bytes, const std::string& name);
bool is_sdf(std::string_view bytes);
SurfaceFile parse_sdf(std::string_view bytes, const std::string& name);
bool is_sur(std::string_view bytes);
SurfaceFile parse_sur(std::string_view bytes, const std::string& name);
bool is_x3p(std::string_view bytes);
SurfaceFile parse_x3p(std::string_view bytes, const std::string& name);
bool is_smd(std::string_view bytes);
SurfaceFile parse_smd(std::string_view bytes, const std::string& name);

inline constexpr std::size_t kMostHeights = std::size_t{1} << 27;

// The number of heights of a grid of columns × rows. Throws Error if one of them is 0 or there are too many.
std::size_t checked_count(std::size_t columns, std::size_t rows, const std::string& name);

// Metres of a unit's name: m, cm, mm, µm (um, micron), nm, Å, pm, in. Throws Error for another; `what` is whose it is.
double length_unit_m(std::string_view unit, const std::string& what, const std::string& name);

// Throws Error naming the value unless it is finite and above 0.
double checked_spacing_m(double spacing_m, const std::string& what, const std::string& name);

// Reads numbers one after the other, least significant byte first. Throws Error where the file ends before.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}
  template <class Number>
  Number take() {
    require(sizeof(Number));
    const auto out = load_number<Number>(bytes_.data() + at_, std::endian::little);
    at_ += sizeof(Number);
    return out;
  }
  std::string_view text(std::size_t size) {
    require(size);
    const std::string_view out = bytes_.substr(at_, size);
    at_ += size;
    return out;
  }
  void skip(std::size_t size) { text(size); }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  void require(std::size_t size) const {
    if (left() < size)
      throw Error(name_ + ": the file ends after " + std::to_string(bytes_.size()) + " bytes, within its content");
  }
  std::string_view bytes_;
  std::string name_;
  std::size_t at_ = 0;
};

}  // namespace asperity
