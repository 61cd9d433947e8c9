#include "asperity/pipeline/write_result.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "asperity/base/csv.h"
#include "asperity/base/in_background.h"
#include "asperity/base/nan.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/pipeline/result_json.h"
#include "asperity/texture/texture_file.h"
#include "json.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kCell_bytes = 22;  // most shortest doubles with their comma; only reserves memory
constexpr std::size_t kDecimalCell_bytes = 16;

void append_cells(std::string& out, std::initializer_list<double> cells) {
  for (const double cell : cells) {
    out += ',';
    append_number(out, cell);
  }
}

constexpr const char* kTrajectoryHeader =
    "t_ns,px_m,py_m,pz_m,qw,qx,qy,qz,vx_mps,vy_mps,vz_mps,sigma_m,sigma_x_m,sigma_y_m,sigma_z_m\n";

void append_trajectory_row(std::string& out, const TipMotion& motion, std::size_t i) {
  const Eigen::Vector3d& p = motion.p_world_tip_m[i];
  const Eigen::Quaterniond& q = motion.q_world_marker[i];
  const Eigen::Vector3d& v = motion.v_world_tip_mps[i];
  const Eigen::Vector3d variance_m2 = motion.cov_world_tip_m2.empty()
                                          ? Eigen::Vector3d::Constant(kNan)
                                          : Eigen::Vector3d(motion.cov_world_tip_m2[i].diagonal());
  const Eigen::Vector3d sigma_m = variance_m2.cwiseSqrt();
  constexpr std::size_t kCells = 14;
  char row[24 + kCells * (1 + kMostDecimalsLength) + 1];
  char* at = std::to_chars(row, row + 24, motion.t_ns[i]).ptr;
  for (const double cell : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z(),
                            std::sqrt(variance_m2.mean()), sigma_m.x(), sigma_m.y(), sigma_m.z()}) {
    *at++ = ',';
    at = put_decimals(at, cell);
  }
  *at++ = '\n';
  out.append(row, at);
}

// Piece by piece: the text of an hour does not fit into memory.
void write_trajectory(const fs::path& path, const TipMotion& motion) {
  constexpr std::size_t kPiece_bytes = std::size_t{4} << 20;
  OutputFile file(path);
  std::string piece = kTrajectoryHeader;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    append_trajectory_row(piece, motion, i);
    if (piece.size() < kPiece_bytes) continue;
    file.append(piece);
    piece.clear();
  }
  file.append(piece);
  file.commit();
}

bool is_result_file(const fs::path& file) {
  constexpr std::uint64_t kLargest_bytes = 64 << 20;
  const Json json = parse_json_or_null(read_file(file, kLargest_bytes));
  return json.is_object() && json.value("format", "") == "asperity-result";
}

// Nothing but the files of one result.
FolderContent is_one_result(const fs::path& folder) {
  constexpr std::array<std::string_view, 6> kOurs{"trajectory.csv", "profile.csv", "spectrum.csv",
                                                  "texture.json",   "result.json", "report.html"};
  if (!fs::is_regular_file(folder / "result.json") || !is_result_file(folder / "result.json")) return false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (std::find(kOurs.begin(), kOurs.end(), entry.path().filename().string()) == kOurs.end())
      return FolderContent::with_added(entry.path().filename());
  }
  return true;
}

// One result, or nothing but folders that hold results, at most `deepest` levels of them, and a report of them all.
FolderContent holds_results(const fs::path& folder, int deepest) {
  if (fs::is_regular_file(folder / "result.json")) return is_one_result(folder);
  bool any = false;
  fs::path added;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (entry.is_regular_file() && name == "report.html") continue;
    const bool may_hold = deepest > 0 && entry.is_directory();
    const FolderContent content = may_hold ? holds_results(entry.path(), deepest - 1) : FolderContent(false);
    any = any || content || !content.added.empty();
    if (!content && added.empty()) added = content.added.empty() ? name : name / content.added;
  }
  // Without a single result it is nobody's addition to one.
  return any && !added.empty() ? FolderContent::with_added(added) : FolderContent(any);
}

}  // namespace

std::string format_trajectory_csv(const TipMotion& motion) {
  std::string out = kTrajectoryHeader;
  out.reserve(out.size() + motion.size() * 15 * kDecimalCell_bytes);
  for (std::size_t i = 0; i < motion.size(); ++i) append_trajectory_row(out, motion, i);
  return out;
}

std::string format_profile_csv(const Profile& profile, const ErodedProfile* surface) {
  const bool eroded = surface != nullptr && surface->determined;
  std::string out = "s_m,height_m,sigma_m,texture_m,force_N,speed_mps,texture_sigma_m";
  out += eroded ? ",surface_m,touched\n" : "\n";
  out.reserve(out.size() + profile.size() * (eroded ? 9 : 7) * kCell_bytes);
  for (std::size_t i = 0; i < profile.size(); ++i) {
    append_number(out, profile.s_m[i]);
    const double texture_sigma_m = profile.texture_sigma_m.empty() ? kNan : profile.texture_sigma_m[i];
    append_cells(out, {profile.height_m[i], profile.sigma_m[i], profile.texture_m[i], profile.force_N[i],
                       profile.speed_mps[i], texture_sigma_m});
    if (eroded) append_cells(out, {surface->surface_m[i], surface->touched[i] != 0 ? 1.0 : 0.0});
    out += '\n';
  }
  return out;
}

std::string format_spectrum_csv(const SurfaceSpectrum& spectrum) {
  std::string out = "cycles_per_mm,density_m2_mm,low_m2_mm,high_m2_mm,noise_m2_mm\n";
  out.reserve(out.size() + spectrum.size() * 5 * kCell_bytes);
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    append_number(out, spectrum.frequency_cycles_per_mm[i]);
    append_cells(out,
                 {spectrum.density_m2_mm[i], spectrum.low_m2_mm[i], spectrum.high_m2_mm[i], spectrum.noise_m2_mm[i]});
    out += '\n';
  }
  return out;
}

void write_result(const fs::path& folder, const ProcessResult& result, const Recording& recording,
                  const std::string& name) {
  write_result(folder, result, result_json(result, recording, name));
}

void write_result(const fs::path& folder, const ProcessResult& result, const Json& json) {
  auto trajectory = in_background([&] { write_trajectory(folder / "trajectory.csv", result.trajectory.motion); });
  write_file(folder / "profile.csv", format_profile_csv(result.profile, result.surface ? &*result.surface : nullptr));
  write_file(folder / "spectrum.csv", format_spectrum_csv(result.spectrum));
  if (result.texture) {
    Texture texture = *result.texture;
    texture.source.recording = json.at("recording").get<std::string>();
    write_texture(folder / "texture.json", texture);
  }
  trajectory.get();
  write_file(folder / "result.json", result_text(json));  // last: by it a folder is a result
}

FolderContent is_result_folder(const fs::path& folder) noexcept {
  constexpr int kDeepest = 2;  // recordings, and their segments
  try {
    return holds_results(folder, kDeepest);
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace asperity
