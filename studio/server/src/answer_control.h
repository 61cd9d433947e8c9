#pragma once

#include <filesystem>

#include "asperity/json/json.h"
#include "asperity/studio/calls.h"
#include "asperity/studio/web_server.h"

namespace asperity::studio {

// What a running studio answers to a command of the same user (running_studios.h):
//   {"request":"list"}                         {"address","folder","port","process","sessions":[…]}
//   {"request":"new-token"}                    {"address"}, with the new token
//   {"request":"close-session","number":3}     {}
// Throws Error for anything else. Thread-safe.
Json answer_control(const Json& request, WebServer& server, const std::filesystem::path& folder);

// What a page may ask: `studio.sessions` gives {"mine":1,"sessions":[…]}, `studio.close_session` {"number":2} ends one.
void bind_sessions(Calls& calls, WebServer& server);

}  // namespace asperity::studio
