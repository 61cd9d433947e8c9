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
enum class CaseClass {
  kNear,
  kFar,
  kBadGuess,
  kNoGuess,
  kSymmetric,
  kWrongMesh,
  kMirrored,
  kWrongScale,
  kVeryWrongScale,
  kFewStarts,
  kByHand
};
inline constexpr std::array<std::string_view, 11> kCaseClassNames{"guess within 5 mm, 5°",
                                                                  "guess within 15 mm, 20°",
                                                                  "guess wrong by 20 to 80 mm, 20 to 180°",
                                                                  "no guess",
                                                                  "symmetric body",
                                                                  "another body's mesh",
                                                                  "the mesh's mirror image",
                                                                  "the mesh 3 to 10 % too large or small",
                                                                  "the mesh 10 to 30 % too large or small",
                                                                  "no guess, few starts",
                                                                  "moved by hand, no search"};

struct PreparedBody {
  Body body;
  std::shared_ptr<const asperity::MeshSurface> surface;
};

// All bodies that cases are drawn from.
struct BodyPool {
  std::vector<PreparedBody> plain, symmetric;
  std::vector<PreparedBody> mirrored;  // of the first of the plain, in their order
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
