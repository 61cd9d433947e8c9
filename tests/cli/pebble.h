#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace asperity::cli {

// A pebble, bumpy and longer than high, at (longitude, latitude), m.
Eigen::Vector3d pebble_point(double longitude, double latitude);

// It as an OBJ in millimetres, facets of about 1.5 mm.
std::string pebble_obj();

// Points of it at (longitude, latitude), as --through takes them, `scale` to a metre.
std::string through(const std::vector<std::array<double, 2>>& places, double scale = 1.0);

}  // namespace asperity::cli
