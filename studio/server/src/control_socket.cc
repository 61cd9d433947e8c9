#include "control_socket.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/json/parse_json.h"
#include "control_folder.h"
#include "secret.h"

namespace asperity::studio {

namespace {

Json refusal_json(const std::string& words) {
  Json out = Json::object();
  out["error"] = words;
  return out;
}

}  // namespace

ControlSocket::ControlSocket(std::function<Json(const Json&)> answer)
    : answer_(std::move(answer)), folder_(open_control_folder(true)) {
  const std::string random = random_secret().substr(0, 16);
  const std::string hidden = "." + random;
  name_ = random + std::string(kControlSuffix);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // By the open folder: its own path may be longer than an address may be.
  std::snprintf(address.sun_path, sizeof address.sun_path, "/proc/self/fd/%d/%s", folder_, hidden.c_str());
  socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  stop_ = ::eventfd(0, EFD_CLOEXEC);
  constexpr int kWaiting = 8;
  // It gets its name when somebody listens: a name behind which nobody does is of a studio that has crashed.
  const bool open =
      socket_ >= 0 && stop_ >= 0 && ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      ::listen(socket_, kWaiting) == 0 && ::renameat(folder_, hidden.c_str(), folder_, name_.c_str()) == 0;
  const int why = errno;
  if (!open) {
    ::unlinkat(folder_, hidden.c_str(), 0);
    for (const int file : {folder_, socket_, stop_}) {
      if (file >= 0) ::close(file);
    }
    throw Error(std::string("the studio's control socket cannot be made: ") + std::strerror(why));
  }
  thread_ = std::thread([this] { run(); });
}

ControlSocket::~ControlSocket() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(stop_, &one, sizeof one);
  thread_.join();
  ::unlinkat(folder_, name_.c_str(), 0);
  for (const int file : {folder_, socket_, stop_}) ::close(file);
}

void ControlSocket::run() noexcept {
  for (;;) {
    std::array<pollfd, 2> watched{{{socket_, POLLIN, 0}, {stop_, POLLIN, 0}}};
    if (::poll(watched.data(), watched.size(), -1) < 0 && errno != EINTR) return;
    if (watched[1].revents != 0) return;
    if (watched[0].revents == 0) continue;
    const int connection = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) {
      // No file descriptor is free: one may be later.
      constexpr int kPause_ms = 100;
      if (::poll(&watched[1], 1, kPause_ms) > 0) return;
      continue;
    }
    try {
      serve(connection);
    } catch (const std::exception&) {
      // No memory for the answer: the other end sees the connection close.
    }
    ::close(connection);
  }
}

void ControlSocket::serve(int connection) const {
  if (!is_own_user(connection)) return;
  const auto line = receive_line(connection, kMostControlRequest_bytes, stop_);
  if (!line) return;
  Json answer;
  try {
    answer = answer_(parse_json(*line, "a request"));
  } catch (const Error& error) {
    answer = refusal_json(error.what());
  }
  send_all(connection, answer.dump_repaired() + "\n");
}

}  // namespace asperity::studio
