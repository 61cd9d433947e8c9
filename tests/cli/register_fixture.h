#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "asperity/geometry/pose.h"
#include "asperity/testkit/temp_dir.h"
#include "pebble.h"
#include "run_asperity.h"

namespace asperity::cli {

// A pebble's mesh in a folder, scans of it, and poses near the true one.
class Register : public testing::Test {
 protected:
  void SetUp() override { write_text(dir_ / "pebble.obj", pebble_obj()); }
  std::string path(const std::string& name) const { return (dir_ / name).string(); }
  std::string mesh() const { return path("pebble.obj"); }

  void simulate(const std::string& name, const std::string& surface, const std::string& points, int seed,
                const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"simulate",
                                   "--surface",
                                   surface,
                                   "--probe",
                                   "open",
                                   "--speed",
                                   "25mm/s",
                                   "--seed",
                                   std::to_string(seed),
                                   "--mesh",
                                   mesh(),
                                   "--mesh-unit",
                                   "mm",
                                   "--through=" + points,
                                   "-o",
                                   path(name)};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  // Points in a row round the pebble, displaced by `T_world_mesh`, with white noise.
  void write_path(const std::string& name, const Pose& T_world_mesh, double noise_m) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::ostringstream out;
    out.precision(10);
    out << "px_m,py_m,pz_m\n";
    for (int i = 0; i < 2000; ++i) {
      const double angle = 2e-3 * i;
      const Eigen::Vector3d noise = noise_m * Eigen::Vector3d(normal(random), normal(random), normal(random));
      const Eigen::Vector3d p = T_world_mesh * pebble_point(angle, 0.5 * std::sin(2.0 * angle)) + noise;
      out << p.x() << ',' << p.y() << ',' << p.z() << '\n';
    }
    write_text(dir_ / name, out.str());
  }

  static nlohmann::json read_json(const std::filesystem::path& file) {
    std::ifstream in(file);
    return nlohmann::json::parse(in);
  }

  static Pose pose_of(const nlohmann::json& v) {
    return {Eigen::Quaterniond(v.at(3), v.at(4), v.at(5), v.at(6)), Eigen::Vector3d(v.at(0), v.at(1), v.at(2))};
  }

  static std::string text_of(const Pose& pose) {
    std::ostringstream out;
    out.precision(12);
    const Eigen::Quaterniond& q = pose.rotation;
    for (const double v :
         {pose.translation_m.x(), pose.translation_m.y(), pose.translation_m.z(), q.w(), q.x(), q.y()}) {
      out << v << ',';
    }
    out << q.z();
    return out.str();
  }

  inline static const Pose kTruth{Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -2).normalized())),
                                  Eigen::Vector3d(0.1, -0.05, 0.3)};

  static Pose off_by(const Pose& T_mesh_world, double shift_m, double turn_rad) {
    const Pose step{Eigen::Quaterniond(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d(2, -1, 2).normalized())),
                    shift_m * Eigen::Vector3d(-1, 2, 2).normalized()};
    return step * T_mesh_world;
  }

  static double turn_between_deg(const Pose& a, const Pose& b) {
    return a.rotation.angularDistance(b.rotation) * 180.0 / std::numbers::pi;
  }

  const testkit::TempDir dir_;
};

}  // namespace asperity::cli
