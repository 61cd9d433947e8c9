#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>

namespace asperity {

// HTTP and a WebSocket to an Inverse Service. One thread at a time; wake() from any. All but close() throw Error in
// words: refused, closed by the service, a message over the limit, out of time.
class InverseServiceClient {
 public:
  using Clock = std::chrono::steady_clock;

  InverseServiceClient(std::string host, int port);
  ~InverseServiceClient();

  // The body of a GET.
  std::string get(const std::string& path, Clock::time_point until);

  void connect(Clock::time_point until);

  // The message is with the kernel when this returns, or an error was thrown.
  void send(std::string_view text, Clock::time_point until);

  // Waits for the next message until `until` or until `stop` and a wake(). True if one came: it is in `text`.
  bool receive(std::string& text, Clock::time_point until, const std::atomic<bool>& stop);

  // Ends a wait in receive() so that it looks at its `stop`.
  void wake() noexcept;

  // Of the connection, for what writes to it beside this (supervisor.h); -1 without one.
  int descriptor() const noexcept;

  // Closes the WebSocket with a handshake while there is time, then the socket.
  void close(Clock::time_point until) noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
