#include "answer_control.h"

#include <unistd.h>

#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/studio/running_studios.h"

namespace asperity::studio {

namespace {

Json list_json(const WebServer& server, const std::filesystem::path& folder) {
  const std::string address = server.address();
  Json out = Json::object();
  out["address"] = address.substr(0, address.find("/#"));
  out["folder"] = folder.string();
  out["port"] = server.port();
  out["process"] = static_cast<int>(::getpid());
  out["sessions"] = sessions_json(server.sessions());
  return out;
}

}  // namespace

Json answer_control(const Json& request, WebServer& server, const std::filesystem::path& folder) {
  const Json* name = request.is_object() ? request.find("request") : nullptr;
  const std::string what = name != nullptr && name->is_string() ? name->text() : std::string();
  Json out = Json::object();
  if (what == "list") return list_json(server, folder);
  if (what == "new-token") {
    server.renew_token();
    out["address"] = server.address();
    return out;
  }
  if (what != "close-session")
    throw Error("the studio does not know this request; check that both have the same version");
  const Json* number = request.find("number");
  if (number == nullptr || !number->is_number_unsigned()) throw Error("a session's number is missing");
  if (!server.close_session(number->get<std::uint64_t>())) {
    throw Error("unknown session " + number->dump() + "; --sessions lists them");
  }
  return out;
}

void bind_sessions(Calls& calls, WebServer& server) {
  calls.add("studio.sessions", [&server](const Request& request) {
    Json out = Json::object();
    out["mine"] = server.session_of(request.client());
    out["sessions"] = sessions_json(server.sessions());
    request.answer(out);
  });
  calls.add("studio.close_session", [&server](const Request& request) {
    const std::int64_t number = request.integer("number");
    if (number < 1 || !server.close_session(static_cast<std::uint64_t>(number))) {
      throw Advice("unknown session " + std::to_string(number), "It may have ended; open the list again.");
    }
    request.done();
  });
}

}  // namespace asperity::studio
