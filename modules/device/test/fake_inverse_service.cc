// Asio's fences are for contexts of several threads; ours have one, and the thread sanitizer knows no fences.
#define BOOST_ASIO_DISABLE_FENCED_BLOCK
// Boost 1.74's Asio uses std::exchange without including its header.
#include <utility>

#include "fake_inverse_service.h"

#include <sys/socket.h>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <list>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <vector>

namespace asperity {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::system::error_code;
using nlohmann::json;
using tcp = asio::ip::tcp;
using Clock = std::chrono::steady_clock;

namespace {

json vector_json(const Eigen::Vector3d& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

}  // namespace

constexpr double kLetsGo_s = 0.1;  // of a service that hangs

struct FakeInverseService::Impl {
  explicit Impl(const FakeInverseConfig& new_config) : config(new_config), p_m(new_config.start_m) {
    plugged = !config.device_id.empty();
    acceptor.open(tcp::v4());
    acceptor.bind({asio::ip::address_v4::loopback(), 0});
    acceptor.listen();
    thread = std::thread([this] { accept(); });
  }

  ~Impl() {
    stopping = true;
    ::shutdown(acceptor.native_handle(), SHUT_RDWR);
    thread.join();
    cut_all();
    for (std::thread& session : sessions) session.join();
  }

  void cut_all() {
    const std::lock_guard lock(mutex);
    for (const int handle : open_handles) ::shutdown(handle, SHUT_RDWR);
  }

  void accept() {
    while (!stopping) {
      error_code error;
      auto socket = std::make_shared<tcp::socket>(context);
      acceptor.accept(*socket, error);
      if (error) continue;
      {
        const std::lock_guard lock(mutex);
        open_handles.insert(socket->native_handle());
      }
      sessions.emplace_back([this, socket] {
        try {
          serve(*socket);
        } catch (const std::exception&) {
          // The client went; so does its session.
        }
        const std::lock_guard lock(mutex);
        open_handles.erase(socket->native_handle());
        move_to(Clock::now());
        force_N.setZero();
      });
    }
  }

  void serve(tcp::socket& socket) {
    beast::flat_buffer buffer;
    http::request<http::string_body> request;
    http::read(socket, buffer, request);
    if (beast::websocket::is_upgrade(request)) return serve_session(socket, request);
    http::response<http::string_body> response(http::status::ok, request.version());
    response.set(http::field::content_type, "application/json");
    if (request.target() == "/version") {
      response.body() = json{{"project_name", "haply-inverse-service"},
                             {"git_tag", config.version},
                             {"project_version", config.version + ".0"}}
                            .dump();
    } else if (request.target() == "/devices") {
      response.body() = frame(true);
    } else {
      response.result(http::status::not_found);
      response.body() = R"({"ok":false,"error":"not found"})";
    }
    response.prepare_payload();
    http::write(socket, response);
  }

  void serve_session(tcp::socket& socket, const http::request<http::string_body>& upgrade) {
    beast::websocket::stream<tcp::socket&> stream(socket);
    socket.set_option(tcp::no_delay(true));
    stream.accept(upgrade);
    stream.text(true);
    stream.write(asio::buffer(frame(true)));
    for (bool first = true;; first = false) {
      beast::flat_buffer buffer;
      error_code error;
      stream.read(buffer, error);
      if (error) {
        const std::lock_guard lock(mutex);
        if (error == beast::websocket::error::closed) ++counted.sessions_closed;
        return;
      }
      take(beast::buffers_to_string(buffer.data()), first);
      while (stalled && !stopping) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      // What it states is of now, whenever it comes.
      for (const std::string& answer : answers()) {
        std::this_thread::sleep_for(std::chrono::microseconds(delay_us));
        stream.write(asio::buffer(answer));
      }
    }
  }

  // The states that one message gets.
  std::vector<std::string> answers() {
    const ServiceTrouble kind = trouble;
    std::string answer = frame(false, kind == ServiceTrouble::kGlitch && glitches++ < 8);
    const std::lock_guard lock(mutex);
    ++counted.answers;
    if (kind == ServiceTrouble::kOutOfOrder && held.empty()) {
      held = std::move(answer);
      return {};
    }
    const std::size_t copies = kind == ServiceTrouble::kDuplicate ? 2 : kind == ServiceTrouble::kFast ? 4 : 1;
    std::vector<std::string> out(copies, answer);
    if (!held.empty()) out.push_back(std::exchange(held, {}));
    return out;
  }

  void take(const std::string& text, bool first) {
    const std::lock_guard lock(mutex);
    ++counted.messages;
    move_to(Clock::now());
    force_N.setZero();  // not persistent: only what this message says
    try {
      const json message = json::parse(text);
      if (message.contains("session")) {
        if (message.at("session").at("configure").at("profile").at("name").get<std::string>().empty()) return;
        ++counted.profiles;
        if (first) counted.profile_first = true;
      }
      const bool vector = config.version >= "3.5";
      for (const json& device : message.at("inverse3")) {
        if (!plugged || device.at("device_id") != config.device_id) continue;
        const json& force = device.at("commands").at("set_cursor_force").at(vector ? "vector" : "values");
        force_N = {force.at("x").get<double>(), force.at("y").get<double>(), force.at("z").get<double>()};
        const double holds_s = stalled ? kLetsGo_s : config.force_holds_s;
        force_until =
            Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(holds_s));
      }
    } catch (const json::exception&) {
      ++counted.unreadable;
    }
    counted.force_N = force_N;
  }

  // The hand's motion in steps short beside m/b, up to `now`; with the lock.
  void move_to(Clock::time_point now) {
    constexpr auto kStep = std::chrono::microseconds(100);
    constexpr double kStep_s = 1e-4;
    for (; moved_to + kStep <= now; moved_to += kStep) {
      if (moved_to > force_until) force_N.setZero();
      v_mps += kStep_s / config.mass_kg * (config.pull_N + force_N - config.damping_N_s_per_m * v_mps);
      p_m += kStep_s * v_mps;
    }
  }

  std::string frame(bool inventory, bool glitch = false) {
    const std::lock_guard lock(mutex);
    if (!inventory && !canned.empty()) return canned;
    move_to(Clock::now());
    const Eigen::Vector3d stated_m = p_m - (glitch ? 30e-3 : 0.0) * Eigen::Vector3d::UnitZ();
    json devices = json::array();
    if (plugged) {
      devices.push_back({{"device_id", config.device_id},
                         {"state",
                          {{"cursor_position", vector_json(stated_m)},
                           {"cursor_velocity", vector_json(v_mps)},
                           {"current_cursor_force", vector_json(force_N)},
                           {"body_orientation", {{"w", 1.0}, {"x", 0.0}, {"y", 0.0}, {"z", 0.0}}}}},
                         {"status", json::object()}});
      if (inventory) devices[0]["config"] = {{"type", "inverse3"}, {"basis", {{"permutation", "XYZ"}}}};
    }
    return json{{"session_id", 7}, {"inverse3", devices}}.dump();
  }

  FakeInverseConfig config;
  asio::io_context context;
  tcp::acceptor acceptor{context};
  std::thread thread;
  std::list<std::thread> sessions;
  std::atomic<bool> stopping{false}, stalled{false};
  std::atomic<int> delay_us{0};
  std::atomic<ServiceTrouble> trouble{ServiceTrouble::kNone};
  std::atomic<int> glitches{0};

  mutable std::mutex mutex;
  std::set<int> open_handles;
  FakeInverseLog counted;
  bool plugged = true;
  std::string canned, held;
  Eigen::Vector3d p_m, v_mps = Eigen::Vector3d::Zero(), force_N = Eigen::Vector3d::Zero();
  Clock::time_point moved_to = Clock::now(), force_until{};
};

FakeInverseService::FakeInverseService(const FakeInverseConfig& config) : impl_(std::make_unique<Impl>(config)) {}
FakeInverseService::~FakeInverseService() = default;

int FakeInverseService::port() const { return impl_->acceptor.local_endpoint().port(); }

FakeInverseLog FakeInverseService::log() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->counted;
}

Eigen::Vector3d FakeInverseService::position_m() const {
  const std::lock_guard lock(impl_->mutex);
  impl_->move_to(Clock::now());
  return impl_->p_m;
}

Eigen::Vector3d FakeInverseService::applied_N() const {
  const std::lock_guard lock(impl_->mutex);
  impl_->move_to(Clock::now());
  return impl_->force_N;
}

void FakeInverseService::unplug() {
  const std::lock_guard lock(impl_->mutex);
  impl_->move_to(Clock::now());
  impl_->plugged = false;
  impl_->force_N.setZero();
}

void FakeInverseService::drop() { impl_->cut_all(); }
void FakeInverseService::stall(bool on) {
  impl_->stalled = on;
  const std::lock_guard lock(impl_->mutex);
  const auto until =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(kLetsGo_s));
  if (on) impl_->force_until = std::min(impl_->force_until, until);
}
void FakeInverseService::answer_after(std::chrono::microseconds time) {
  impl_->delay_us = static_cast<int>(time.count());
}

void FakeInverseService::trouble(ServiceTrouble kind) { impl_->trouble = kind; }

void FakeInverseService::answer_with(const std::string& text) {
  const std::lock_guard lock(impl_->mutex);
  impl_->canned = text;
}

}  // namespace asperity
