#include "haply_protocol.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include <fmt/format.h>
#include <Eigen/LU>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"

namespace asperity {

namespace {

constexpr double kFarthest_m = 10.0, kFastest_mps = 100.0;

Json parse_bounded(std::string_view text) {
  if (text.size() > kMostFrame_bytes) {
    throw Error(fmt::format("haply: a frame of {} bytes, more than {}", text.size(), kMostFrame_bytes));
  }
  JsonLimits limits;
  limits.depth = kDeepestJson;
  return parse_json(text, "haply", limits);
}

std::string text_at(const Json& object, const char* key) {
  const Json* value = object.find(key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

Eigen::Vector3d vector_at(const Json& state, const char* key, double most, const std::string& device_id) {
  const Json* vector = state.find(key);
  Eigen::Vector3d result;
  for (int i = 0; i < 3; ++i) {
    const char name[2] = {static_cast<char>('x' + i), '\0'};
    const Json* number = vector == nullptr ? nullptr : vector->find(name);
    if (number == nullptr || !number->is_number()) {
      throw Error(fmt::format("haply: device '{}': no number {}.{} in its state", device_id, key, name));
    }
    result[i] = number->get<double>();
    if (!(std::abs(result[i]) <= most)) {
      throw Error(fmt::format("haply: device '{}': {}.{} is {}, more than {}", device_id, key, name,
                              number_text(result[i]), number_text(most)));
    }
  }
  return result;
}

bool is_device_id(std::string_view id) {
  return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_' ||
           c == '.' || c == ':';
  });
}

std::string listed(const Json& devices) {
  std::string list;
  for (std::size_t i = 0; i < std::min<std::size_t>(devices.size(), 8); ++i) {
    list += (list.empty() ? "" : ", ") + printable(text_at(devices[i], "device_id"));
  }
  return list;
}

}  // namespace

HaplyForceKey parse_service_version(std::string_view body) {
  const Json document = parse_bounded(body);
  const Json* inner = document.find("data");
  const Json& facts = inner == nullptr ? document : *inner;
  std::string version = text_at(facts, "project_version");
  if (version.empty()) version = text_at(facts, "git_tag");
  const auto dot = version.find('.');
  const auto major = parse_int64(std::string_view(version).substr(0, dot));
  const auto rest = dot == std::string::npos ? std::string_view() : std::string_view(version).substr(dot + 1);
  const auto minor = parse_int64(rest.substr(0, rest.find('.')));
  if (!major || !minor) throw Error("haply: GET /version names no version: '" + printable(body) + "'");
  if (*major < 3 || (*major == 3 && *minor < 1)) {
    throw Error("haply: Inverse Service " + printable(version) + " is too old; 3.1 is needed");
  }
  return *major == 3 && *minor < 5 ? HaplyForceKey::kValues : HaplyForceKey::kVector;
}

HaplyState parse_haply_frame(std::string_view text, std::string_view device_id) {
  const Json frame = parse_bounded(text);
  const Json* devices = frame.find("inverse3");
  if (devices == nullptr || !devices->is_array() || devices->empty()) {
    throw Error(device_id.empty()
                    ? "haply: the service has no Inverse3"
                    : fmt::format("haply: device '{}' is gone: the service has no Inverse3", printable(device_id)));
  }
  const Json* wanted = std::find_if(devices->begin(), devices->end(), [&](const Json& device) {
    return device_id.empty() || text_at(device, "device_id") == device_id;
  });
  if (wanted == devices->end()) {
    throw Error(
        fmt::format("haply: device '{}' is not in the service's list ({})", printable(device_id), listed(*devices)));
  }
  HaplyState result;
  result.device_id = text_at(*wanted, "device_id");
  if (!is_device_id(result.device_id)) {
    throw Error("haply: '" + printable(result.device_id) + "' is not a device's id");
  }
  if (const Json* config = wanted->find("config")) result.model = printable(text_at(*config, "type"));
  const Json* state = wanted->find("state");
  if (state == nullptr) throw Error(fmt::format("haply: device '{}' has no state", result.device_id));
  result.p_m = vector_at(*state, "cursor_position", kFarthest_m, result.device_id);
  result.v_mps = vector_at(*state, "cursor_velocity", kFastest_mps, result.device_id);
  return result;
}

void write_haply_command(std::string& out, std::string_view device_id, const Eigen::Vector3d& force_N,
                         HaplyForceKey key, bool first) {
  out = first ? R"({"session":{"configure":{"profile":{"name":"asperity"}}},)" : "{";
  out += R"("inverse3":[{"device_id":")";
  out += device_id;
  out += R"(","commands":{"set_cursor_force":{")";
  out += key == HaplyForceKey::kVector ? "vector" : "values";
  out += R"(":{"x":)";
  append_number(out, force_N.x());
  out += R"(,"y":)";
  append_number(out, force_N.y());
  out += R"(,"z":)";
  append_number(out, force_N.z());
  out += "}}}}]}";
}

std::vector<std::byte> websocket_frame(std::string_view text) {
  constexpr unsigned char kWholeText = 0x81, kMasked = 0x80, kTwoBytesOfLength = 126;
  // Any key will do: masks keep what a page of a browser sends from being taken for another protocol.
  constexpr std::array<unsigned char, 4> kMask{0x37, 0x9A, 0x51, 0xC2};
  if (text.size() > 0xFFFF) throw Error("haply: a frame of " + std::to_string(text.size()) + " bytes");
  std::vector<unsigned char> out{kWholeText};
  if (text.size() < kTwoBytesOfLength) {
    out.push_back(static_cast<unsigned char>(kMasked | text.size()));
  } else {
    out.insert(out.end(), {kMasked | kTwoBytesOfLength, static_cast<unsigned char>(text.size() >> 8U),
                           static_cast<unsigned char>(text.size() & 0xFFU)});
  }
  out.insert(out.end(), kMask.begin(), kMask.end());
  for (std::size_t i = 0; i < text.size(); ++i)
    out.push_back(static_cast<unsigned char>(static_cast<unsigned char>(text[i]) ^ kMask[i % kMask.size()]));
  const auto bytes = std::as_bytes(std::span(out));
  return {bytes.begin(), bytes.end()};
}

Eigen::Matrix3d parse_haply_axes(std::string_view axes) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
  std::size_t at = 0;
  for (int row = 0; row < 3; ++row) {
    const bool negative = at < axes.size() && axes[at] == '-';
    if (at < axes.size() && (axes[at] == '-' || axes[at] == '+')) ++at;
    const char axis = at < axes.size() ? axes[at++] : '\0';
    if (axis < 'X' || axis > 'Z') break;
    R(row, axis - 'X') = negative ? -1.0 : 1.0;
  }
  // Of a matrix of zeros and signs, one a row, the determinant is 1 exactly for a right-handed set of axes.
  if (at != axes.size() || R.determinant() != 1.0) {
    throw Error("haply: axes '" + printable(axes) + "' are not X, Y and Z in some order, right-handed, as in 'XZ-Y'");
  }
  return R;
}

}  // namespace asperity
