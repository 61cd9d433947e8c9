// Registration of a path of 2,000 points on a mesh of some 70,000 triangles and 100 mm from starts that are off:
// processor time, error over the Cramér–Rao limit, starts recovered; ours, the seed's scheme and, where it is
// installed, PCL's point-to-plane ICP. The mesh is a generated bumpy body or an OBJ file's, scaled to 100 mm.
//
//   register_bench [--mesh FILE.obj] [--starts N] [--noise_mm S] [--shift_mm D] [--turn_deg A]

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Dense>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/base/text.h"
#include "asperity/registration/register_path.h"
#include "asperity/registration/register_thesis.h"
#include "peers/register_peer.h"
#include "read_options.h"

namespace {

using asperity::Pose;
using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct Options {
  std::string mesh;
  int starts = 20;
  double noise_m = 0.15e-3;
  double shift_m = 5e-3;
  double turn_rad = 5.0 * std::numbers::pi / 180.0;
};

Options parse_options(int argc, char** argv) {
  Options out;
  bench::read_options(
      argc, argv,
      {{"--mesh", [&](auto value) { out.mesh = value; }},
       {"--starts", [&](auto value) { out.starts = static_cast<int>(bench::number_within(value, 1.0, 1e5)); }},
       {"--noise_mm", [&](auto value) { out.noise_m = 1e-3 * bench::number_within(value, 0.0, 1e3); }},
       {"--shift_mm", [&](auto value) { out.shift_m = 1e-3 * bench::number_within(value, 0.0, 1e3); }},
       {"--turn_deg",
        [&](auto value) { out.turn_rad = std::numbers::pi / 180.0 * bench::number_within(value, 0.0, 180.0); }}});
  return out;
}

// Waves of 15 to 75 mm and 1 to 2 % of their length on an ellipsoid; the sphere it is made of is a blown-up cube.
asperity::TriangleMesh bumpy_mesh() {
  constexpr std::uint32_t kSide = 76;  // 69,312 triangles
  asperity::Random random(1);
  struct Wave {
    Vector3d k;
    double phase = 0.0;
    double amplitude = 0.0;
  };
  std::vector<Wave> waves(10);
  for (Wave& wave : waves) {
    const Vector3d direction = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const double length = random.uniform(0.3, 1.5);
    wave = {direction * 2.0 * std::numbers::pi / length, random.uniform(0.0, 2.0 * std::numbers::pi), 0.02 * length};
  }
  asperity::TriangleMesh mesh;
  for (int face = 0; face < 6; ++face) {
    const auto base = static_cast<std::uint32_t>(mesh.vertices_m.size());
    const double side = face % 2 == 0 ? 1.0 : -1.0;
    for (std::uint32_t i = 0; i <= kSide; ++i) {
      for (std::uint32_t j = 0; j <= kSide; ++j) {
        Vector3d u;
        u(face / 2) = side;
        u((face / 2 + 1) % 3) = std::tan(std::numbers::pi / 4.0 * (2.0 * i / kSide - 1.0));
        u((face / 2 + 2) % 3) = side * std::tan(std::numbers::pi / 4.0 * (2.0 * j / kSide - 1.0));
        u.normalize();
        double r = 0.05;
        for (const Wave& wave : waves) r += 0.05 * wave.amplitude * std::sin(wave.k.dot(u) + wave.phase);
        mesh.vertices_m.push_back(r * u.cwiseProduct(Vector3d(1.0, 0.85, 0.7)));
      }
    }
    for (std::uint32_t i = 0; i < kSide; ++i) {
      for (std::uint32_t j = 0; j < kSide; ++j) {
        const std::uint32_t a = base + i * (kSide + 1) + j;
        const std::uint32_t b = a + kSide + 1;
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
      }
    }
  }
  return mesh;
}

// `v` and `f` lines of an OBJ file; triangles split in four until there are 60,000, the longest extent made 100 mm.
asperity::TriangleMesh obj_mesh(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw asperity::Error(file + ": cannot be opened");
  asperity::TriangleMesh mesh;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Vector3d p;
      words >> p.x() >> p.y() >> p.z();
      mesh.vertices_m.push_back(p);
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      while (words >> word) {
        const auto index = asperity::parse_int64(word.substr(0, word.find('/')));
        if (!index || *index < 1) throw asperity::Error(file + ": face index '" + asperity::printable(word) + "'");
        corners.push_back(static_cast<std::uint32_t>(*index - 1));
      }
      for (std::size_t k = 2; k < corners.size(); ++k)
        mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
  }
  if (mesh.triangles.empty()) throw asperity::Error(file + ": no triangles");
  while (mesh.triangles.size() < 60000) {
    asperity::TriangleMesh fine;
    for (const auto& t : mesh.triangles) {
      const auto base = static_cast<std::uint32_t>(fine.vertices_m.size());
      for (const auto i : t) fine.vertices_m.push_back(mesh.vertices_m.at(i));
      for (std::size_t e = 0; e < 3; ++e) {
        fine.vertices_m.push_back(0.5 * (mesh.vertices_m[t[e]] + mesh.vertices_m[t[(e + 1) % 3]]));
      }
      fine.triangles.push_back({base, base + 3, base + 5});
      fine.triangles.push_back({base + 3, base + 1, base + 4});
      fine.triangles.push_back({base + 5, base + 4, base + 2});
      fine.triangles.push_back({base + 3, base + 4, base + 5});
    }
    mesh = std::move(fine);
  }
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : mesh.vertices_m) box.extend(p);
  for (Vector3d& p : mesh.vertices_m) p = (p - box.center()) * 0.1 / box.sizes().maxCoeff();
  return mesh;
}

// A wave round the body: what is seen of it from all around.
std::vector<Vector3d> path_on(const asperity::MeshBvh& bvh) {
  constexpr int kPoints = 2000;
  std::vector<Vector3d> out;
  for (int i = 0; i < kPoints; ++i) {
    const double t = i / (kPoints - 1.0);
    const double latitude = 0.6 * std::sin(6.0 * std::numbers::pi * t);
    const double longitude = 4.0 * t;
    const Vector3d u(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                     std::sin(latitude));
    // From outside, as a probe comes; where it misses the body, the nearest point.
    const asperity::RayHit hit = bvh.cast_ray(0.2 * u, -u, 0.2);
    out.push_back(hit.found() ? Vector3d((0.2 - hit.t) * u) : bvh.closest_point(0.05 * u).p_m);
  }
  return out;
}

struct Limit {
  double rms_m = 0.0;
  Vector3d mean_m = Vector3d::Zero();
};

Limit cramer_rao(const asperity::TriangleMesh& mesh, const asperity::MeshBvh& bvh, const std::vector<Vector3d>& path,
                 double noise_m) {
  Limit out;
  for (const Vector3d& p : path) out.mean_m += p / static_cast<double>(path.size());
  Matrix6 information = Matrix6::Zero();
  Matrix6 metric = Matrix6::Zero();
  for (const Vector3d& p : path) {
    const auto& [a, b, c] = mesh.triangles[bvh.closest_point(p).triangle];
    const auto& v = mesh.vertices_m;
    const Vector3d n = (v[b] - v[a]).cross(v[c] - v[a]).normalized();
    Eigen::Matrix<double, 6, 1> row;
    row << (p - out.mean_m).cross(n), n;
    information += row * row.transpose();
    Eigen::Matrix<double, 3, 6> motion;
    motion << -asperity::skew(p - out.mean_m), Eigen::Matrix3d::Identity();
    metric += motion.transpose() * motion / static_cast<double>(path.size());
  }
  out.rms_m = noise_m * std::sqrt((information.inverse() * metric).trace());
  return out;
}

double processor_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

// The figures of one tool over the starts.
struct Row {
  std::vector<double> ms;
  double square_m2 = 0.0;
  int recovered = 0;

  void add(double time_ms, double error_m, double limit_m) {
    ms.push_back(time_ms);
    if (error_m > 3.0 * limit_m) return;
    ++recovered;
    square_m2 += error_m * error_m;
  }

  void print(std::string_view name, double limit_m) {
    std::sort(ms.begin(), ms.end());
    std::printf("%-28s %10.2f %14.2f %12d of %zu\n", std::string(name).c_str(), ms[ms.size() / 2],
                recovered == 0 ? std::nan("") : std::sqrt(square_m2 / recovered) / limit_m, recovered, ms.size());
  }
};

void run(const Options& options) {
  const asperity::TriangleMesh mesh = options.mesh.empty() ? bumpy_mesh() : obj_mesh(options.mesh);
  const asperity::MeshBvh bvh(mesh);
  const asperity::RegistrationSurface surface = asperity::prepare_surface(mesh, bvh);
  const std::vector<Vector3d> path_m = path_on(bvh);
  const Limit limit = cramer_rao(mesh, bvh, path_m, options.noise_m);
  std::printf("%zu triangles, %zu points, noise %.3f mm, starts %.1f mm and %.1f deg off, limit %.4f mm\n",
              mesh.triangles.size(), path_m.size(), 1e3 * options.noise_m, 1e3 * options.shift_m,
              options.turn_rad * 180.0 / std::numbers::pi, 1e3 * limit.rms_m);
  std::printf("%-28s %10s %14s %12s\n", "", "median ms", "error / limit", "recovered");
  asperity::RegistrationConfig facet_config;
  facet_config.normals = asperity::RegistrationNormals::kFacet;
  asperity::PeerRegistration peer(mesh);
  Row ours, facets, thesis, theirs;
  asperity::Random random(2);
  const auto direction = [&random] { return Vector3d(random.normal(), random.normal(), random.normal()).normalized(); };
  for (int s = 0; s < options.starts; ++s) {
    const Pose truth{asperity::exp_rotation(random.uniform(0.0, 3.0) * direction()), 0.1 * direction()};
    asperity::MeasuredPath path;
    for (const Vector3d& p : path_m) {
      path.p_world_m.push_back(
          truth * Vector3d(p + options.noise_m * Vector3d(random.normal(), random.normal(), random.normal())));
    }
    const Eigen::Quaterniond turn = asperity::exp_rotation(options.turn_rad * direction());
    const Pose guess = Pose{turn, limit.mean_m + options.shift_m * direction() - turn * limit.mean_m} * truth.inverse();
    const auto measure = [&](Row& row, const auto& registration) {
      const double begin_ms = processor_ms();
      const Pose found = registration();
      const double time_ms = processor_ms() - begin_ms;
      double square = 0.0;
      for (const Vector3d& p : path_m) square += (found * (truth * p) - p).squaredNorm();
      row.add(time_ms, std::sqrt(square / static_cast<double>(path_m.size())), limit.rms_m);
    };
    measure(ours, [&] { return asperity::register_path({&path, 1}, surface, guess, {}).T_mesh_world; });
    measure(facets, [&] { return asperity::register_path({&path, 1}, surface, guess, facet_config).T_mesh_world; });
    measure(thesis, [&] { return asperity::register_thesis({&path, 1}, bvh, guess, {}).T_mesh_world; });
    if (peer.name() != nullptr) measure(theirs, [&] { return peer.align(path.p_world_m, guess); });
  }
  ours.print("register_path", limit.rms_m);
  facets.print("register_path, facet normals", limit.rms_m);
  thesis.print("register_thesis", limit.rms_m);
  if (peer.name() != nullptr) {
    theirs.print(peer.name(), limit.rms_m);
  } else {
    std::printf("PCL: not installed, skipped\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse_options(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "register_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
