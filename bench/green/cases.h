#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/geometry/mesh_surface.h"
#include "asperity/pipeline/register_config.h"
#include "bodies.h"
#include "paths.h"

namespace bench {

// How a case begins, and what is wrong with it.
enum class CaseClass { kNear, kFar, kBadGuess, kNoGuess, kSymmetric, kWrongMesh, kWrongScale, kFewStarts, kByHand };
inline constexpr std::array<std::string_view, 9> kCaseClassNames{"guess within 5 mm, 5°",
                                                                 "guess within 15 mm, 20°",
                                                                 "guess wrong by 20 to 80 mm, 20 to 180°",
                                                                 "no guess",
                                                                 "symmetric body",
                                                                 "wrong mesh",
                                                                 "wrong scale",
                                                                 "no guess, few starts",
                                                                 "moved by hand, no search"};

struct PreparedBody {
  Body body;
  std::shared_ptr<const asperity::MeshSurface> surface;
};

// All bodies that cases are drawn from.
struct BodyPool {
  std::vector<PreparedBody> plain, symmetric;
};

BodyPool make_bodies(const std::vector<std::string>& files, std::uint64_t seed);

struct RegistrationCase {
  CaseClass kind = CaseClass::kNear;
  std::string body;
  Symmetry symmetry;
  std::shared_ptr<const asperity::MeshSurface> surface;  // to which the paths are registered
  std::vector<LineOnMesh> lines;
  PathErrors errors;
  std::vector<asperity::MeasuredPath> paths;
  std::optional<asperity::Pose> T_mesh_world, guess;  // the truth, unless the mesh is wrong
  double scale = 1.0;                                 // of the mesh over the object
  asperity::RegisterConfig config;
};

// Case `number` of a seed.
RegistrationCase draw_case(const BodyPool& pool, std::uint64_t seed, std::uint64_t number);

}  // namespace bench
