#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {

// A plate of 60 × 20 mm with its face at z = 0, cells of 2 mm, in millimetres; no underside.
inline std::string plate_obj() {
  std::ostringstream out;
  for (int j = 0; j <= 10; ++j) {
    for (int i = 0; i <= 30; ++i) out << "v " << 2 * i << ' ' << 2 * j << " 0\n";
  }
  for (int j = 0; j < 10; ++j) {
    for (int i = 0; i < 30; ++i) {
      const int a = 31 * j + i + 1;
      out << "f " << a << ' ' << a + 1 << ' ' << a + 32 << ' ' << a + 31 << '\n';
    }
  }
  return out.str();
}

// Cosines of 2.5 mm and 0.1 mm height: after the lift the texture lies between 0 and 0.2 mm.
inline constexpr const char* kTexture =
    R"({"format":"asperity-texture","version":1,"name":"wave","model":"fourier1d",)"
    R"("fourier1d":{"length_mm":10,"omega_rad_per_mm":0.6283185307179586,"a_m":[0,0,0,0.0001],"b_m":[0,0,0,0],"mean_m":0},)"
    R"("compliance_kc":1,"extra":{}})";

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  std::vector<double> column(const std::string& name) const {
    const auto at = std::find(columns.begin(), columns.end(), name) - columns.begin();
    std::vector<double> out;
    for (const auto& row : rows) out.push_back(row.at(static_cast<std::size_t>(at)));
    return out;
  }
};

inline Table read_header(const std::filesystem::path& file) {
  std::ifstream in(file);
  Table out;
  std::string line, cell;
  std::getline(in, line);
  for (std::stringstream cells(line); std::getline(cells, cell, ',');) out.columns.push_back(cell);
  return out;
}

inline Table read_table(const std::filesystem::path& file) {
  std::ifstream in(file);
  Table out;
  std::string line, cell;
  std::getline(in, line);
  for (std::stringstream cells(line); std::getline(cells, cell, ',');) out.columns.push_back(cell);
  while (std::getline(in, line)) {
    out.rows.emplace_back();
    for (std::stringstream cells(line); std::getline(cells, cell, ',');) {
      double value = 0.0;
      const auto end = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      EXPECT_EQ(end.ptr, cell.data() + cell.size()) << cell;
      out.rows.back().push_back(value);
    }
  }
  return out;
}

inline std::string text_of(double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

class FeelCommands : public testing::Test {
 protected:
  FeelCommands() {
    write_text(path("plate.obj"), plate_obj());
    write_text(path("wave.texture.json"), kTexture);
    const Outcome painted = run({"paint", path("plate.obj"), "--mesh-unit", "mm", "--through", "5,10,0;55,10,0",
                                 "--width", "12mm", "--texture", path("wave.texture.json"), "-o", path("scene")});
    EXPECT_EQ(painted.code, 0) << painted.err;
  }
  std::string path(const std::string& name) const { return (dir_ / name).string(); }

  Outcome feel(const std::string& scene, const std::vector<std::string>& more) const {
    std::vector<std::string> words{"feel", scene};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }

  // Down from 2 mm above to `depth_m` in 0.1 s, then along x at 50 mm/s; a row every `step_ns`, beginning at
  // `start_ns`.
  void write_stroke(const std::string& name, double depth_m, std::int64_t start_ns, std::int64_t step_ns) const {
    std::string out = "t_ns,px_m,py_m,pz_m\n";
    for (std::int64_t t_ns = 0; t_ns <= 400'000'000; t_ns += step_ns) {
      const double t_s = 1e-9 * static_cast<double>(t_ns);
      const double down = std::min(t_s / 0.1, 1.0);
      out += std::to_string(start_ns + t_ns) + "," + text_of(0.02 + 0.05 * std::max(t_s - 0.1, 0.0)) + ",0.01," +
             text_of(2e-3 - down * (2e-3 + depth_m)) + "\n";
    }
    write_text(path(name), out);
  }

  testkit::TempDir dir_;
};

}  // namespace asperity::cli
