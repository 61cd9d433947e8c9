#pragma once

#include <filesystem>

#include "asperity/json/json.h"
#include "asperity/studio/web_server.h"

namespace asperity::studio {

// What a running studio answers to a command of the same user (running_studios.h):
//   {"request":"list"}                         {"address","folder","port","process","sessions":[…]}
//   {"request":"new-token"}                    {"address"}, with the new token
//   {"request":"close-session","number":3}     {}
// Throws Error for anything else. Thread-safe.
Json answer_control(const Json& request, WebServer& server, const std::filesystem::path& folder);

// As in the list and in the page's call studio.sessions.
Json sessions_json(const std::vector<SessionInfo>& sessions);

}  // namespace asperity::studio
