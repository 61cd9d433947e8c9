#include "asperity/session/feel_log.h"

#include <Eigen/Core>

#include "asperity/base/text.h"
#include "asperity/session/our_file.h"

namespace asperity {

namespace {

constexpr std::size_t kPiece_bytes = 1 << 20;

void append_vector(std::string& out, const Eigen::Vector3d& v) {
  for (int k = 0; k < 3; ++k) {
    out += ',';
    append_number(out, v[k]);
  }
}

double signed_texture_N(const ServoOutput& output) {
  const double magnitude_N = output.texture_N.norm();
  return output.texture_N.dot(output.contact.normal_world) < 0.0 ? -magnitude_N : magnitude_N;
}

std::filesystem::path checked(const std::filesystem::path& file) {
  refuse_stranger(file, kFeelLogColumns);
  return file;
}

}  // namespace

void append_feel_row(std::string& out, const ServoTick& tick) {
  const ServoOutput& output = tick.output;
  append_number(out, tick.t_ns);
  append_vector(out, tick.p_world_m);
  append_vector(out, output.proxy_m);
  append_vector(out, output.force_N);
  for (const double value :
       {output.contact_N.norm(), signed_texture_N(output), output.friction_N.norm(), output.texture_height_m}) {
    out += ',';
    append_number(out, value);
  }
  append_vector(out, tick.out_world_N);
}

FeelLog::FeelLog(const std::filesystem::path& file, bool timing) : file_(checked(file)), timing_(timing) {
  rows_.reserve(kPiece_bytes + (1 << 12));
  rows_ = kFeelLogColumns;
  rows_ += timing ? ",step_ns\n" : "\n";
}

void FeelLog::add(const ServoTick& tick) {
  append_feel_row(rows_, tick);
  if (timing_) {
    rows_ += ',';
    append_number(rows_, tick.step_ns);
  }
  rows_ += '\n';
  if (rows_.size() < kPiece_bytes) return;
  file_.append(rows_);
  rows_.clear();
}

void FeelLog::commit() {
  file_.append(rows_);
  rows_.clear();
  file_.commit();
}

}  // namespace asperity
