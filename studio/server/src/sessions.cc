#include "sessions.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <utility>

#include "asperity/base/text.h"
#include "secret.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kMostAgent_bytes = 100;

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

}  // namespace

Sessions::Sessions(std::size_t most) : most_(most), token_(random_secret()) {}

std::string Sessions::token() const {
  const std::lock_guard lock(mutex_);
  return token_;
}

std::optional<std::uint64_t> Sessions::number_of(std::string_view cookie) const {
  std::optional<std::uint64_t> found;
  for (const auto& [number, session] : sessions_) {
    if (same_secret(cookie, session.cookie)) found = number;
  }
  return found;
}

bool Sessions::make_room() {
  if (sessions_.size() < most_) return true;
  const auto idle =
      std::find_if(sessions_.begin(), sessions_.end(), [](const auto& entry) { return entry.second.windows.empty(); });
  if (idle == sessions_.end()) return false;
  sessions_.erase(idle);
  return true;
}

Sessions::Admitted Sessions::admit(std::string_view token, const Visitor& visitor) {
  const std::lock_guard lock(mutex_);
  if (!same_secret(token, token_)) return {Answer::kWrongToken, {}};
  if (visitor.cookie && number_of(*visitor.cookie)) return {Answer::kWelcome, *visitor.cookie};
  if (!make_room()) return {Answer::kFull, {}};
  Session session;
  session.cookie = random_secret();
  session.info = {last_number_ + 1, utc_now(), visitor.from, printable(visitor.agent, kMostAgent_bytes), 0};
  const std::string cookie = session.cookie;
  sessions_.emplace(++last_number_, std::move(session));
  return {Answer::kWelcome, cookie};
}

std::optional<std::uint64_t> Sessions::find(std::string_view cookie) const {
  const std::lock_guard lock(mutex_);
  return number_of(cookie);
}

bool Sessions::add_window(std::uint64_t session, ClientId client, std::function<void()> close) {
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(session);
  if (found == sessions_.end()) return false;
  found->second.windows.emplace(client, std::move(close));
  return true;
}

void Sessions::remove_window(ClientId client) {
  const std::lock_guard lock(mutex_);
  for (auto& [number, session] : sessions_) session.windows.erase(client);
}

std::uint64_t Sessions::session_of(ClientId client) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [number, session] : sessions_) {
    if (session.windows.contains(client)) return number;
  }
  return 0;
}

void Sessions::renew() {
  std::string fresh = random_secret();
  std::map<std::uint64_t, Session> ended;
  {
    const std::lock_guard lock(mutex_);
    token_ = std::move(fresh);
    ended = std::exchange(sessions_, {});
  }
  for (const auto& [number, session] : ended) {
    for (const auto& [client, close_window] : session.windows) close_window();
  }
}

bool Sessions::close(std::uint64_t session) {
  std::map<std::uint64_t, Session>::node_type ended;
  {
    const std::lock_guard lock(mutex_);
    ended = sessions_.extract(session);
  }
  if (ended.empty()) return false;
  for (const auto& [client, close_window] : ended.mapped().windows) close_window();
  return true;
}

std::vector<SessionInfo> Sessions::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<SessionInfo> out;
  for (const auto& [number, session] : sessions_) {
    out.push_back(session.info);
    out.back().windows = static_cast<int>(session.windows.size());
  }
  return out;
}

}  // namespace asperity::studio
