// The studio's stream from a sensor to a browser, and the servo loop beside it: a server as the studio's, a client over
// a plain socket. Four channels at 4 kHz in blocks of a thirtieth of a second, and a picture of 640 by 480 with each.
//
//   studio_stream [MINUTES]      10 if not given; before them a fifth of that, a minute at most, without a client

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/servo_loop.h"
#include "asperity/json/parse_json.h"
#include "asperity/studio/web_server.h"
#include "raw_client.h"
#include "servo_plate.h"

namespace {

using asperity::Error;
using asperity::Json;
using namespace asperity::studio;
using Clock = std::chrono::steady_clock;

constexpr double kRate_Hz = 4000.0, kBlocks_per_s = 30.0;
constexpr std::size_t kChannels = 4, kWidth = 640, kHeight = 480;

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

double cpu_s(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Publishes as a scan would until it is stopped.
void feed(WebServer& server, const std::atomic<bool>& stop, std::atomic<std::uint64_t>& blocks) {
  std::vector<float> values;
  std::vector<std::uint8_t> picture(kWidth * kHeight);
  std::uint64_t samples = 0;
  const auto start = Clock::now();
  for (std::uint64_t i = 1; !stop; ++i) {
    std::this_thread::sleep_until(
        start + std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * static_cast<double>(i) / kBlocks_per_s)));
    const auto due = static_cast<std::uint64_t>(kRate_Hz * static_cast<double>(i) / kBlocks_per_s);
    const std::size_t count = due - samples;
    samples = due;
    values.assign(count * kChannels, static_cast<float>(i));
    std::fill(picture.begin(), picture.end(), static_cast<std::uint8_t>(i));
    // What nobody sees is not made.
    if (!server.has_subscribers("scan.probe")) continue;
    BlockWriter probe("probe");
    probe.head()["topic"] = "scan.probe";
    probe.head()["sequence"] = blocks++;
    probe.head()["newest_ns"] = now_ns();
    probe.head()["samples"] = count;
    probe.add("values", values, {count, kChannels});
    server.publish("scan.probe", probe.take(), Delivery::kSeries);
    BlockWriter image("image");
    image.head()["topic"] = "scan.image";
    image.head()["newest_ns"] = now_ns();
    image.add("grey", picture, {kHeight, kWidth});
    server.publish("scan.image", image.take(), Delivery::kLatest);
  }
}

struct Received {
  std::uint64_t blocks = 0, samples = 0, pictures = 0, bytes = 0;
  std::vector<double> probe_ms, picture_ms;  // from the newest sample or the picture to the client
  double cpu_s = 0.0;
  std::string failure;
};

// A browser that follows both topics until it is told the end.
void follow(int port, const std::string& cookie, Received& out) {
  try {
    RawClient client = open_websocket(port, cookie);
    for (const char* topic : {"scan.image", "scan.probe"}) {
      client.send(RawClient::frame(1, std::string(R"({"id":1,"call":"subscribe","args":{"topic":")") + topic + "\"}}"));
    }
    std::uint64_t expected = 0;
    for (;;) {
      const auto frame = client.next_frame();
      if (!frame) throw Error("the server closed the connection");
      const double now = static_cast<double>(now_ns());
      if (frame->opcode == 1) {
        if (frame->payload.find("\"end\"") != std::string::npos) break;
        continue;
      }
      std::uint32_t head_bytes = 0;
      std::memcpy(&head_bytes, frame->payload.data() + 4, sizeof head_bytes);
      const Json head = asperity::parse_json(frame->payload.substr(8, head_bytes));
      const double age_ms = 1e-6 * (now - head.at("newest_ns").get<double>());
      out.bytes += frame->payload.size();
      if (head.at("kind") == "image") {
        ++out.pictures;
        out.picture_ms.push_back(age_ms);
        continue;
      }
      // Between the two subscriptions and at the end nothing may be lost either.
      const auto sequence = head.at("sequence").get<std::uint64_t>();
      if (sequence < expected) throw Error("blocks came out of order");
      expected = sequence + 1;
      ++out.blocks;
      out.samples += head.at("samples").get<std::uint64_t>();
      out.probe_ms.push_back(age_ms);
    }
  } catch (const std::exception& error) {
    out.failure = error.what();
  }
  out.cpu_s = cpu_s(RUSAGE_THREAD);
}

void print_latency(const char* name, std::vector<double> ms) {
  if (ms.empty()) return;
  std::sort(ms.begin(), ms.end());
  const auto at = [&ms](double p) { return ms[static_cast<std::size_t>(p * static_cast<double>(ms.size() - 1))]; };
  std::printf("%-22s %8.2f %8.2f %8.2f %8.2f ms  (p50, p99, p99.9, max)\n", name, at(0.5), at(0.99), at(0.999),
              at(1.0));
}

void print_servo(const char* name, const asperity::ServoStatistics& s) {
  std::printf("%-22s %8llu ticks, late p50 %.1f, p99 %.1f, max %.1f µs, %llu overruns, %llu skipped%s\n", name,
              static_cast<unsigned long long>(s.ticks), 1e6 * s.late_p50_s, 1e6 * s.late_p99_s, 1e6 * s.late_max_s,
              static_cast<unsigned long long>(s.overruns), static_cast<unsigned long long>(s.skipped),
              s.real_time ? ", SCHED_FIFO" : "");
  std::fflush(stdout);
}

void run(double minutes) {
  WebServerConfig config;
  const auto server = WebServer::start(config, {});
  const std::string cookie = session_cookie(server->port(), server->address());
  std::atomic<bool> stop{false};
  std::atomic<std::uint64_t> blocks{0};
  std::thread feeder([&] { feed(*server, stop, blocks); });
  const double spin_s = asperity::ServoConfig{}.spin_s, servo_Hz = 1000.0;
  print_servo("servo, no client", asperity::stroke_plate(std::min(60.0, 12.0 * minutes), servo_Hz, spin_s));

  Received received;
  const double cpu_before_s = cpu_s(RUSAGE_SELF), servo_before_s = cpu_s(RUSAGE_THREAD);
  const auto began = Clock::now();
  std::thread client([&] { follow(server->port(), cookie, received); });
  print_servo("servo, one client", asperity::stroke_plate(60.0 * minutes, servo_Hz, spin_s));
  const double servo_s = cpu_s(RUSAGE_THREAD) - servo_before_s;
  stop = true;
  feeder.join();
  server->broadcast("end", Json::object());
  client.join();
  const double wall_s = std::chrono::duration<double>(Clock::now() - began).count();
  if (!received.failure.empty()) throw Error("the client: " + received.failure);

  const auto count = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
  std::printf(
      "series                 %llu blocks sent, %llu received, %llu lost; %llu samples in %.1f s; %llu dropped by the "
      "server\n",
      count(blocks), count(received.blocks), count(blocks - received.blocks), count(received.samples), wall_s,
      count(server->dropped_frames()));
  std::printf("pictures               %llu received; %.1f MB/s in all\n", count(received.pictures),
              1e-6 * static_cast<double>(received.bytes) / wall_s);
  print_latency("newest sample → client", received.probe_ms);
  print_latency("picture → client", received.picture_ms);
  std::printf("CPU of server and feed %8.2f %% of a core, of the client %.2f %%\n",
              100.0 * (cpu_s(RUSAGE_SELF) - cpu_before_s - servo_s - received.cpu_s) / wall_s,
              100.0 * received.cpu_s / wall_s);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto minutes = asperity::parse_double(argc > 1 ? argv[1] : "10");
    if (!minutes || !(*minutes > 0.0 && *minutes <= 1440.0))
      throw Error("MINUTES must be more than 0 and at most 1440");
    run(*minutes);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "studio_stream: %s\n", error.what());
    return 1;
  }
  return 0;
}
