#include "asperity/session/study_stimuli.h"

#include <string_view>

#include "asperity/base/crc32.h"
#include "asperity/base/csv.h"
#include "asperity/base/text.h"
#include "asperity/study/study_error.h"
#include "asperity/texture/read_height_image.h"
#include "asperity/texture/texture_file.h"

namespace asperity {

namespace {

constexpr std::uint64_t kLargestImage_bytes = std::uint64_t{1} << 30U;

}  // namespace

bool is_image(const std::string& name) { return name.ends_with(".png") || name.ends_with(".pgm"); }

Stimuli read_stimuli(const Study& study, const std::function<std::filesystem::path(const std::string&)>& find) {
  ReadHeightImageConfig image;
  image.width_mm = study.presentation.tile_mm;
  image.range_mm = study.presentation.range_mm;
  Stimuli out;
  for (const std::string& name : study.stimuli) {
    const std::filesystem::path file = find(name);
    std::string bytes;
    if (is_image(name)) {
      bytes = read_file(file, kLargestImage_bytes);
      out.textures.push_back(parse_height_image(bytes, file.string(), image));
    } else {
      out.textures.push_back(read_texture(file, [&](std::string_view content) { bytes.append(content); }));
    }
    out.crc32.push_back(asperity::crc32(bytes));
    const bool slippery = !(out.textures.back().friction.value_or(study.presentation.friction) > 0.0);
    if (study.method == StudyMethod::kStaircase && study.parameter == StudyParameter::kFrictionDifference && slippery) {
      throw StudyError(StudyFault::kNoFriction, printable(name, 200) + ": has no friction to change");
    }
  }
  return out;
}

void check_unchanged(const Study& study, const Stimuli& stimuli, const std::vector<std::uint32_t>& logged_crc32) {
  std::string changed;
  std::size_t count = 0;
  for (std::size_t k = 0; k < logged_crc32.size(); ++k) {
    if (logged_crc32[k] == stimuli.crc32.at(k)) continue;
    changed += (count++ > 0 ? ", " : "") + printable(study.stimuli.at(k), 200);
  }
  if (count == 0) return;
  throw StudyError(StudyFault::kTexturesChanged,
                   changed + (count == 1 ? " has" : " have") + " changed since this session began");
}

}  // namespace asperity
