#include "studio_sessions.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"

namespace asperity::app {

namespace {

constexpr std::size_t kMostShown = 200;

std::string line_of(const studio::RunningStudio& studio) {
  return fmt::format("{}  {}  process {}", printable(studio.address, kMostShown), printable(studio.folder, kMostShown),
                     studio.process);
}

bool is_meant(const studio::RunningStudio& studio, const StudioChoice& choice) {
  if (choice.port != 0 && studio.port != choice.port) return false;
  std::error_code error;
  return !choice.folder || std::filesystem::equivalent(*choice.folder, studio.folder, error);
}

}  // namespace

std::vector<studio::RunningStudio> chosen_studios(const StudioChoice& choice) {
  std::vector<studio::RunningStudio> out = studio::running_studios();
  std::erase_if(out, [&](const studio::RunningStudio& studio) { return !is_meant(studio, choice); });
  return out;
}

studio::RunningStudio chosen_studio(const StudioChoice& choice) {
  std::vector<studio::RunningStudio> found = chosen_studios(choice);
  if (found.empty()) throw Error("none of your studios is running for that folder and port");
  if (found.size() == 1) return std::move(found.front());
  std::string all;
  for (const studio::RunningStudio& studio : found) all += "\n  " + line_of(studio);
  throw Error(fmt::format("{} of your studios are running; choose one by its folder or --port:{}", found.size(), all));
}

std::string sessions_text(const std::vector<studio::RunningStudio>& studios) {
  if (studios.empty()) return "studio     none is running\n";
  std::string out;
  for (const studio::RunningStudio& studio : studios) {
    out += "studio     " + line_of(studio) + "\n";
    for (const studio::SessionInfo& session : studio.sessions) {
      out += fmt::format("session    {}  opened {} from {}, {} window{} open  {}\n", session.number,
                         printable(session.opened), printable(session.from), session.windows,
                         session.windows == 1 ? "" : "s", printable(session.agent, kMostShown));
    }
  }
  return out;
}

std::string sessions_json(const std::vector<studio::RunningStudio>& studios) {
  Json list = Json::array();
  for (const studio::RunningStudio& studio : studios) {
    Json each = Json::object();
    each["address"] = studio.address;
    each["folder"] = studio.folder;
    each["port"] = studio.port;
    each["process"] = studio.process;
    each["sessions"] = studio::sessions_json(studio.sessions);
    list.push_back(std::move(each));
  }
  Json out = Json::object();
  out["studios"] = std::move(list);
  return out.dump_repaired();
}

}  // namespace asperity::app
