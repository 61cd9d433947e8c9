#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "asperity/base/problem.h"
#include "asperity/texture/autoregressive.h"

namespace asperity {

struct ImportPennConfig {
  double rate_Hz = 1000.0;
  double mass_kg = 0.05;
  double offset_sigmas = 3.0;

  template <class V>
  void visit(V& v) {
    v.field("rate_Hz", rate_Hz, "of the models; the file does not say it (the toolkit has sets at 1 and 10 kHz)",
            {1.0, 1e6});
    v.field("mass_kg", mass_kg, "effective mass of tool and hand; the toolkit renders with 0.05", {0.0, 1e3});
    v.field("lift_sigma", offset_sigmas,
            "standard deviations by which normal forces are lifted; 0: forces of both signs", {0.0, 10.0});
  }
};

struct PennTexture {
  AutoregressiveTexture texture;
  std::optional<double> friction;  // mu
  Problems problems;               // "triangles_replaced"
};

// A texture of the Penn Haptic Texture Toolkit (Culbertson, Lopez Delgado and Kuchenbecker 2014), Models_*.xml:
//   modelSet / mu, numMod, numTri, maxSpeed, maxForce, numARCoeff, numMACoeff,
//              speedList/value…, forceList/value…, tri/value×3 (repeated, counted from 1),
//              model / ARlsf/value…, MAlsf/value…, gain, var, speedMod, forceMod      (repeated)
// Speeds in mm/s, forces in N, accelerations in m/s², frequencies in rad a sample. Lists may also be written as numbers
// parted by blanks or commas; other elements and attributes are passed over; speedList, forceList, the counts, gain and
// MAlsf may be missing. What is there must be right: counts that agree, models in the order of the lists, numbers that
// are numbers. A triangulation that does not fit its models (counted from 0, an index too many) is replaced by our own,
// with a Problem. Throws Error naming file, line and element, for more than 8 MiB, elements nested deeper than 16, a
// document type declaration, or more models, triangles or frequencies than a texture may have.
PennTexture import_penn(const std::filesystem::path& path, const ImportPennConfig& config = {});

// The same from text in memory; `name` is what messages call it.
PennTexture parse_penn(std::string_view text, const std::string& name, const ImportPennConfig& config = {});

}  // namespace asperity
