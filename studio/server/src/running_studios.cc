#include "asperity/studio/running_studios.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "control_folder.h"

namespace asperity::studio {

namespace {

class Descriptor {
 public:
  explicit Descriptor(int file) : file_(file) {}
  ~Descriptor() {
    if (file_ >= 0) ::close(file_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return file_; }

 private:
  int file_;
};

// The answer of the studio behind a socket; none if it gives none. One behind which nobody listens is removed.
std::optional<Json> ask(int folder, const std::string& socket, const Json& request) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const int length =
      std::snprintf(address.sun_path, sizeof address.sun_path, "/proc/self/fd/%d/%s", folder, socket.c_str());
  if (length < 0 || static_cast<std::size_t>(length) >= sizeof address.sun_path) return std::nullopt;
  const Descriptor connection(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (connection.get() < 0) return std::nullopt;
  if (::connect(connection.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    if (errno == ECONNREFUSED) ::unlinkat(folder, socket.c_str(), 0);
    return std::nullopt;
  }
  if (!is_own_user(connection.get()) || !send_all(connection.get(), request.dump_repaired() + "\n")) {
    return std::nullopt;
  }
  const auto line = receive_line(connection.get(), kMostControlAnswer_bytes);
  if (!line) return std::nullopt;
  Json answer = parse_json_or_null(*line);
  return answer.is_object() ? std::optional<Json>(std::move(answer)) : std::nullopt;
}

Json request_json(const char* name) {
  Json out = Json::object();
  out["request"] = name;
  return out;
}

std::vector<std::string> sockets_in(int folder) {
  std::vector<std::string> out;
  const int copy = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (copy < 0) return out;
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(::fdopendir(copy), ::closedir);
  if (!entries) return out;
  while (const dirent* entry = ::readdir(entries.get())) {
    const std::string name = entry->d_name;
    if (name.ends_with(kControlSuffix) && !name.starts_with('.')) out.push_back(name);
  }
  return out;
}

RunningStudio studio_of(const std::string& socket, const Json& answer) {
  RunningStudio out;
  out.socket = socket;
  out.address = answer.value("address", "");
  out.folder = answer.value("folder", "");
  out.port = answer.value("port", out.port);
  out.process = answer.value("process", out.process);
  const Json* sessions = answer.find("sessions");
  for (std::size_t i = 0; sessions != nullptr && i < sessions->size(); ++i) {
    const Json& each = sessions->at(i);
    SessionInfo info;
    info.number = each.value("number", std::uint64_t{0});
    info.opened = each.value("opened", "");
    info.from = each.value("from", "");
    info.agent = each.value("agent", "");
    info.windows = each.value("windows", info.windows);
    out.sessions.push_back(std::move(info));
  }
  return out;
}

Json ask_or_throw(const RunningStudio& studio, const Json& request) {
  const Descriptor folder(open_control_folder(false));
  auto answer = folder.get() < 0 ? std::nullopt : ask(folder.get(), studio.socket, request);
  if (!answer) throw Error("the studio at " + printable(studio.address, 200) + " does not answer; it may have ended");
  if (const Json* error = answer->find("error")) throw Error(printable(error->text(), 200));
  return std::move(*answer);
}

}  // namespace

Json sessions_json(const std::vector<SessionInfo>& sessions) {
  Json out = Json::array();
  for (const SessionInfo& session : sessions) {
    Json each = Json::object();
    each["number"] = session.number;
    each["opened"] = session.opened;
    each["from"] = session.from;
    each["agent"] = session.agent;
    each["windows"] = session.windows;
    out.push_back(std::move(each));
  }
  return out;
}

std::vector<RunningStudio> running_studios() {
  std::vector<RunningStudio> out;
  const Descriptor folder(open_control_folder(false));
  if (folder.get() < 0) return out;
  for (const std::string& socket : sockets_in(folder.get())) {
    const auto answer = ask(folder.get(), socket, request_json("list"));
    if (answer && !answer->contains("error")) out.push_back(studio_of(socket, *answer));
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.port < b.port; });
  return out;
}

std::string renew_token(const RunningStudio& studio) {
  return ask_or_throw(studio, request_json("new-token")).value("address", "");
}

void close_session(const RunningStudio& studio, std::uint64_t session) {
  Json request = request_json("close-session");
  request["number"] = session;
  ask_or_throw(studio, request);
}

}  // namespace asperity::studio
