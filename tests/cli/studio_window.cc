#include "studio_window.h"

#include <chrono>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace asperity::cli {

using Json = nlohmann::json;

StudioWindow::StudioWindow(const std::filesystem::path& out) : client_(connect(out)) {}

StudioWindow::~StudioWindow() {
  leaving_ = true;
  if (heart_.joinable()) heart_.join();
}

studio::RawClient StudioWindow::connect(const std::filesystem::path& out) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (std::chrono::steady_clock::now() < end) {
    std::ifstream in(out);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const auto begin = text.find("http://");
    const auto stop = text.find_first_of(" \n\"", begin);
    if (begin != std::string::npos && stop != std::string::npos) {
      const std::string address = text.substr(begin, stop - begin);
      const int port = std::stoi(address.substr(address.find(':', 7) + 1));
      return studio::open_websocket(port, studio::session_cookie(port, address));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  throw std::runtime_error("the studio does not tell its address");
}

Json StudioWindow::call(const std::string& name, const Json& arguments) {
  const std::lock_guard lock(mutex_);
  const int id = ++last_id_;
  client_.send(studio::RawClient::frame(1, Json{{"id", id}, {"call", name}, {"args", arguments}}.dump()));
  for (;;) {
    const auto frame = client_.next_frame();
    if (!frame) throw std::runtime_error(name + ": the studio has gone");
    if (frame->opcode != 1) continue;
    const Json answer = Json::parse(frame->payload);
    if (answer.value("id", 0) != id) continue;
    if (answer.contains("error")) throw std::runtime_error(name + ": " + answer["error"].dump());
    return answer.value("result", Json());
  }
}

void StudioWindow::edit(const std::string& path, const Json& value) {
  call("document.edit", {{"path", path}, {"value", value}, {"label", "test"}, {"gesture", ""}});
}

void StudioWindow::keep_lease() {
  call("lease.acquire");
  heart_ = std::thread([this] {
    try {
      while (!leaving_) {
        call("lease.heartbeat");
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
      }
    } catch (const std::exception&) {
      // It was stopped, or has ended.
    }
  });
}

}  // namespace asperity::cli
