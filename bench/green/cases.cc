#include "cases.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace bench {

namespace {

using asperity::Pose;
using asperity::Random;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;

Vector3d any_direction(Random& random) {
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

// Cases of a class in twenty-four. Most are made to go wrong.
constexpr std::array<int, 11> kShares{1, 1, 2, 2, 1, 6, 3, 2, 4, 1, 1};

CaseClass draw_class(std::uint64_t number) {
  auto at = static_cast<int>(number % 24);
  std::size_t kind = 0;
  while (at >= kShares[kind]) at -= kShares[kind++];
  return static_cast<CaseClass>(kind);
}

const PreparedBody& draw(const std::vector<PreparedBody>& bodies, Random& random) {
  return bodies[static_cast<std::size_t>(random.uniform() * static_cast<double>(bodies.size()))];
}

Pose guess_off(const RegistrationCase& of, double least_m, double most_m, double least_deg, double most_deg,
               Random& random) {
  Vector3d centre_m = Vector3d::Zero();
  for (const Vector3d& p_m : of.lines.front().p_m) centre_m += p_m / static_cast<double>(of.lines.front().p_m.size());
  const Eigen::Quaterniond turn =
      asperity::exp_rotation(random.uniform(least_deg, most_deg) * kDegree * any_direction(random));
  const Vector3d shift_m = random.uniform(least_m, most_m) * any_direction(random);
  return Pose{turn, centre_m + shift_m - turn * centre_m} * *of.T_mesh_world;
}

}  // namespace

BodyPool make_bodies(const std::vector<std::string>& files, std::uint64_t seed) {
  BodyPool out;
  const auto add = [](std::vector<PreparedBody>& to, Body body) {
    auto surface = std::make_shared<const asperity::MeshSurface>(body.mesh);
    to.push_back({std::move(body), std::move(surface)});
  };
  constexpr std::uint64_t kPebbles = 8;
  for (std::uint64_t i = 0; i < kPebbles; ++i) add(out.plain, make_bumpy_pebble(1000 * seed + i));
  for (const std::string& file : files) add(out.plain, read_body(file, 110e-3));
  // Of the pebbles alone: the mirror image of an animal is nearly the animal.
  for (std::uint64_t i = 0; i < kPebbles; ++i) add(out.mirrored, mirrored(out.plain[i].body));
  add(out.symmetric, make_sphere(35e-3));
  add(out.symmetric, make_ellipsoid({45e-3, 36e-3, 28e-3}));
  add(out.symmetric, make_box({80e-3, 60e-3, 40e-3}));
  add(out.symmetric, make_prism(3, 45e-3, 70e-3));
  add(out.symmetric, make_prism(6, 40e-3, 90e-3));
  add(out.symmetric, make_cylinder(30e-3, 80e-3));
  return out;
}

RegistrationCase draw_case(const BodyPool& pool, std::uint64_t seed, std::uint64_t number) {
  Random random(seed, 1000 + number);
  RegistrationCase out;
  out.kind = draw_class(number);
  const std::vector<PreparedBody>& bodies = out.kind == CaseClass::kSymmetric ? pool.symmetric : pool.plain;
  const std::size_t drawn_from = out.kind == CaseClass::kMirrored ? pool.mirrored.size() : bodies.size();
  const auto of_pool = static_cast<std::size_t>(random.uniform() * static_cast<double>(drawn_from));
  const PreparedBody& body = bodies[of_pool];
  out.body = body.body.name;
  out.symmetry = body.body.symmetry;
  out.surface = body.surface;
  const int scans = random.chance(0.7) ? 1 : 2 + static_cast<int>(random.uniform() * 2.0);
  out.errors = draw_errors(random);
  const Pose T_world_mesh{asperity::exp_rotation(random.uniform(0.0, std::numbers::pi) * any_direction(random)),
                          0.3 * any_direction(random)};
  out.T_mesh_world = T_world_mesh.inverse();
  for (int i = 0; i < scans; ++i) {
    const double length_m = 40e-3 * std::pow(10.0, random.uniform());
    const auto kind = static_cast<LineKind>(static_cast<int>(random.uniform() * 3.0));
    out.lines.push_back(walk_over(*body.surface, kind, length_m, random));
    out.paths.push_back(measure_line(out.lines.back(), out.errors, T_world_mesh, random));
  }
  switch (out.kind) {
    case CaseClass::kNear:
      out.guess = guess_off(out, 0.0, 5e-3, 0.0, 5.0, random);
      break;
    case CaseClass::kFar:
      out.guess = guess_off(out, 0.0, 15e-3, 0.0, 20.0, random);
      break;
    case CaseClass::kBadGuess:
      out.guess = guess_off(out, 20e-3, 80e-3, 20.0, 180.0, random);
      break;
    case CaseClass::kSymmetric:
      if (random.chance(0.5)) out.guess = guess_off(out, 0.0, 15e-3, 0.0, 20.0, random);
      break;
    case CaseClass::kWrongMesh: {
      const PreparedBody* other = &body;
      while (other == &body) other = &draw(random.chance(0.7) ? pool.plain : pool.symmetric, random);
      out.surface = other->surface;
      out.body += " on " + other->body.name;
      if (random.chance(0.5)) out.guess = guess_off(out, 0.0, 15e-3, 0.0, 20.0, random);
      out.T_mesh_world.reset();
      break;
    }
    case CaseClass::kMirrored: {
      const PreparedBody& other = pool.mirrored[of_pool];
      out.surface = other.surface;
      out.body = other.body.name;
      if (random.chance(0.5)) out.guess = guess_off(out, 0.0, 15e-3, 0.0, 20.0, random);
      out.T_mesh_world.reset();
      break;
    }
    case CaseClass::kWrongScale:
    case CaseClass::kVeryWrongScale: {
      const bool very = out.kind == CaseClass::kVeryWrongScale;
      const double off = very ? random.uniform(0.1, 0.3) : random.uniform(0.03, 0.1);
      out.scale = random.chance(0.5) ? 1.0 + off : 1.0 - off;
      if (random.chance(0.5)) out.guess = guess_off(out, 0.0, 10e-3, 0.0, 10.0, random);
      asperity::TriangleMesh mesh = body.body.mesh;
      for (Vector3d& vertex_m : mesh.vertices_m) vertex_m *= out.scale;
      out.surface = std::make_shared<const asperity::MeshSurface>(mesh);
      break;
    }
    case CaseClass::kFewStarts:
      out.config.search.rotations = 40;
      out.config.search.positions = 6;
      out.config.search.coarse_runs = 6;
      out.config.search.refined = 2;
      break;
    case CaseClass::kByHand:
      out.guess = guess_off(out, 0.0, 30e-3, 0.0, 40.0, random);
      out.config.search.registration.starts.when = asperity::OtherStarts::kNever;
      out.config.refinement.other_starts = 0;
      break;
    case CaseClass::kNoGuess:
      break;
  }
  return out;
}

}  // namespace bench
