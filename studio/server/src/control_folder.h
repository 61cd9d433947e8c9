#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace asperity::studio {

// What the two ends of a studio's control socket share (control_socket.h, running_studios.h).

inline constexpr std::size_t kMostControlRequest_bytes = 4U << 10U;
inline constexpr std::size_t kMostControlAnswer_bytes = 1U << 20U;
inline constexpr auto kControlPatience = std::chrono::seconds(2);
inline constexpr std::string_view kControlSuffix = ".studio";

// The open folder of this user's control sockets: in XDG_RUNTIME_DIR, or else in the folder for temporary files. Made
// if `make`; -1 if it is not there. Throws Error if it cannot be made, or is not this user's alone.
int open_control_folder(bool make);

// True if the other end of a connected Unix socket is a program of this user.
bool is_own_user(int connection);

// Both within kControlPatience: a line without its end, none if it does not come or is longer than `most`; and all of
// `text`, false if it is not taken. `stop`, if not -1, ends the wait once it can be read.
std::optional<std::string> receive_line(int connection, std::size_t most, int stop = -1);
bool send_all(int connection, std::string_view text);

}  // namespace asperity::studio
