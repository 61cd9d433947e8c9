#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "asperity/json/json.h"
#include "asperity/studio/session_info.h"

namespace asperity::studio {

// A studio of this user that runs on this machine.
struct RunningStudio {
  std::string socket;   // the name by which it is spoken to
  std::string address;  // "http://127.0.0.1:8137", without the token
  std::string folder;   // that it works in
  int port = 0;
  int process = 0;
  std::vector<SessionInfo> sessions;
};

// As commands and pages receive them: [{"number","opened","from","agent","windows"}].
Json sessions_json(const std::vector<SessionInfo>& sessions);

// In the order of their ports. Those that do not answer within two seconds are left out; what a crashed one left
// behind is removed. Throws Error if the folder of their sockets is not this user's alone.
std::vector<RunningStudio> running_studios();

// Ends the studio's token and all its sessions; returns the new address, with the new token. Throws Error if the studio
// does not answer.
std::string renew_token(const RunningStudio& studio);

// Ends one session. Throws Error if there is none of that number, or the studio does not answer.
void close_session(const RunningStudio& studio, std::uint64_t session);

}  // namespace asperity::studio
