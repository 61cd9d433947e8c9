#include "pebble.h"

#include <cmath>
#include <numbers>
#include <sstream>

namespace asperity::cli {

using Eigen::Vector3d;

Vector3d pebble_point(double longitude, double latitude) {
  const Vector3d out(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                     std::sin(latitude));
  const double bump = std::sin(7.0 * out.x() + 1.0) * std::sin(6.0 * out.y()) * std::cos(5.0 * out.z() - 0.5);
  return (1.0 + 0.06 * bump) * Vector3d(0.045, 0.036, 0.028).cwiseProduct(out);
}

std::string pebble_obj() {
  constexpr int kRows = 80, kColumns = 160;
  std::ostringstream out;
  for (int row = 1; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Vector3d p =
          1e3 * pebble_point(2.0 * std::numbers::pi * column / kColumns, std::numbers::pi * (row - 40) / kRows);
      out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
  }
  for (int row = 0; row + 2 < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const int a = row * kColumns + column + 1, b = row * kColumns + (column + 1) % kColumns + 1;
      out << "f " << a << ' ' << b << ' ' << b + kColumns << ' ' << a + kColumns << '\n';
    }
  }
  return out.str();
}

std::string through(const std::vector<std::array<double, 2>>& places, double scale) {
  std::ostringstream out;
  for (const auto& [longitude, latitude] : places) {
    const Vector3d p = scale * pebble_point(longitude, latitude);
    out << (out.tellp() > 0 ? ";" : "") << p.x() << ',' << p.y() << ',' << p.z();
  }
  return out.str();
}

}  // namespace asperity::cli
