#pragma once

#include <functional>
#include <string>
#include <thread>

#include "asperity/json/json.h"

namespace asperity::studio {

// The door of a running studio for commands of the same user: a Unix socket in a folder that only this user can enter,
// which asks the system for the user at the other end. One line of JSON each way.
class ControlSocket {
 public:
  // `answer` is called on a thread of its own; what it throws is answered as {"error":"…"}. Throws Error if there is
  // no folder for the socket.
  explicit ControlSocket(std::function<Json(const Json& request)> answer);
  ~ControlSocket();
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;

 private:
  void run() noexcept;
  void serve(int connection) const;

  std::function<Json(const Json&)> answer_;
  int folder_ = -1, socket_ = -1, stop_ = -1;
  std::string name_;
  std::thread thread_;
};

}  // namespace asperity::studio
