#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/studio/hub.h"
#include "asperity/studio/session_info.h"

namespace asperity::studio {

// The token of a server and the sessions that were opened with it, each with a cookie of its own. Thread-safe.
class Sessions {
 public:
  explicit Sessions(std::size_t most);

  // What is in the address that is printed.
  std::string token() const;

  struct Visitor {
    std::string from, agent;
    std::optional<std::string> cookie;  // that it sent: a session that is there already is continued
  };
  enum class Answer { kWelcome, kWrongToken, kFull };
  struct Admitted {
    Answer answer = Answer::kWrongToken;
    std::string cookie;
  };
  // Opens a session for the token. Beyond the most that may be, the oldest without a window ends; kFull if all have
  // one.
  Admitted admit(std::string_view token, const Visitor& visitor);

  // The number of the session of a cookie's value.
  std::optional<std::uint64_t> find(std::string_view cookie) const;

  // A WebSocket of a session; false if that was closed meanwhile. `close` is called once, on any thread, when the
  // session is closed; must only pass it on.
  bool add_window(std::uint64_t session, ClientId client, std::function<void()> close);
  void remove_window(ClientId client);
  // The session that has this window; 0 if none has.
  std::uint64_t session_of(ClientId client) const;

  // A new token: the old one and all sessions end.
  void renew();
  // False without such a session.
  bool close(std::uint64_t session);
  // In the order in which they were opened.
  std::vector<SessionInfo> list() const;

 private:
  struct Session {
    std::string cookie;
    SessionInfo info;
    std::map<ClientId, std::function<void()>> windows;
  };

  bool make_room();
  std::optional<std::uint64_t> number_of(std::string_view cookie) const;

  const std::size_t most_;
  mutable std::mutex mutex_;
  std::string token_;
  std::map<std::uint64_t, Session> sessions_;  // by number
  std::uint64_t last_number_ = 0;
};

}  // namespace asperity::studio
