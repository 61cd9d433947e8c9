#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// Sizes of what a service may send.
constexpr std::size_t kMostFrame_bytes = 256 * 1024;
constexpr std::size_t kDeepestJson = 16;

// What the service's version calls the three numbers of set_cursor_force.
enum class HaplyForceKey { kVector, kValues };

// From the body of GET /version ({"project_version": "3.5.0.0", …}, perhaps inside "data"): "values" in 3.1 to 3.4,
// "vector" from 3.5 on. Throws Error if it is no such body, or below 3.1: another format on another port.
HaplyForceKey parse_service_version(std::string_view body);

// One device of a frame, in the service's axes.
struct HaplyState {
  std::string device_id;
  std::string model;  // its type, if the frame says it
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_mps = Eigen::Vector3d::Zero();
};

// The state of `device_id` (empty: of the first device) in an inventory or state frame. Throws Error if the text is
// not JSON of at most kDeepestJson levels, has no such device, or its numbers are missing or absurd (10 m, 100 m/s).
HaplyState parse_haply_frame(std::string_view text, std::string_view device_id);

// A client's message into `out`: a force in N in the service's axes; with `first`, also the session's profile.
void write_haply_command(std::string& out, std::string_view device_id, const Eigen::Vector3d& force_N,
                         HaplyForceKey key, bool first);

// A message as a client's whole frame on the wire (RFC 6455, 5.2: text, masked), for a process that has no client.
// Throws Error for one of more than 65,535 bytes.
std::vector<std::byte> websocket_frame(std::string_view text);

// The rotation from the service's axes to the device's: "XZ-Y" is x = X, y = Z, z = −Y. Throws Error unless `axes`
// names each axis once and keeps the handedness.
Eigen::Matrix3d parse_haply_axes(std::string_view axes);

}  // namespace asperity
