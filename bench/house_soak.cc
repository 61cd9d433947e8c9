// The house at work for an hour (docs/safety.md): the recorder at 4 kHz and 120 Hz, the studio with three windows, one
// of which strokes a surface while two watch it and a scan of the bench, and `feel` on a played 2diy. Each is a
// process of its own; once a tenth of the time its memory, descriptors and threads are read from /proc.
//   house_soak [MINUTES]     60 if not given; fails if one ends early, loses something, or grows

#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/testkit/temp_dir.h"
#include "fake_two_diy_board.h"
#include "raw_client.h"
#include "watched_process.h"

namespace {

using asperity::Error;
using asperity::Json;
using asperity::WatchedProcess;
using asperity::studio::RawClient;
using Clock = std::chrono::steady_clock;

constexpr int kReadings = 10;
// Of the readings after the first: what a heap that is used and given back may breathe.
constexpr double kMostGrowth_MiB = 8.0;
constexpr double kLeastHeld =
    0.3;  // of the time the hand must have felt the block, of the two thirds in which it pushes
constexpr double kStroke_s = 30.0;  // how often the bench's hand strokes again

double s_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Window {
  std::uint64_t frames = 0, bytes = 0, ticks = 0, rows = 0, lost_rows = 0, errors = 0;
  std::string failure, scan;
};

std::string call(const std::string& name, const Json& arguments) {
  return RawClient::frame(1, Json{{"id", 1}, {"call", name}, {"args", arguments}}.dump());
}

Json edit(const std::string& path, const Json& value) {
  return {{"path", path}, {"value", value}, {"label", "soak"}, {"gesture", ""}};
}

void count(const std::string& payload, std::uint64_t& next_row, Window& out) {
  std::uint32_t head_bytes = 0;
  std::memcpy(&head_bytes, payload.data() + 4, sizeof head_bytes);
  const Json head = asperity::parse_json(payload.substr(8, head_bytes));
  if (head.value("topic", "") == "feel.ticks") {
    for (const Json& array : head.at("arrays"))
      if (array.at("name") == "t_s") out.ticks += array.at("shape").at(0).get<std::uint64_t>();
  }
  if (head.value("topic", "") == "scan.state") out.scan = head.dump();
  if (head.value("topic", "") != "scan.probe") return;
  std::uint64_t rows = 0;
  for (const Json& array : head.at("arrays"))
    if (array.at("name") == "t_s") rows = array.at("shape").at(0).get<std::uint64_t>();
  const auto first = head.at("sequence").get<std::uint64_t>();
  if (next_row != 0 && first > next_row) out.lost_rows += first - next_row;
  next_row = first + rows;
  out.rows += rows;
}

// A window until `stop`; the first one owns the force and strokes back and forth over the surface.
void watch(int port, const std::string& cookie, bool strokes, const std::atomic<bool>& stop, Window& out) {
  try {
    RawClient client = asperity::studio::open_websocket(port, cookie);
    for (const char* topic : {"feel.state", "feel.ticks", "scan.state", "scan.probe", "scan.image"})
      client.send(call("subscribe", {{"topic", topic}}));
    if (strokes) {
      client.send(call("lease.acquire", Json::object()));
      client.send(call("document.edit", edit("/feel/height_maps", {"wave.pgm"})));
      client.send(call("document.edit", edit("/scan/source", "bench")));
      client.send(call("document.edit", edit("/scan/name", "soak")));
      client.send(call("scan.open", Json::object()));
    }
    const auto start = Clock::now();
    double pointer_s = 0.0, heart_s = 0.0, begin_s = 3.0, scan_s = 4.0;
    std::uint32_t sequence = 0;
    std::uint64_t next_row = 0;
    while (!stop) {
      const auto frame = client.next_frame();
      if (!frame) throw Error("the studio closed the connection");
      ++out.frames;
      out.bytes += frame->payload.size();
      if (frame->opcode == 2) count(frame->payload, next_row, out);
      if (frame->opcode == 1 && frame->payload.find("\"error\"") != std::string::npos && ++out.errors == 1)
        std::printf("window: %s\n", frame->payload.c_str());
      const double now_s = s_since(start);
      if (strokes && now_s >= heart_s) {
        heart_s = now_s + 0.1;
        client.send(call("lease.heartbeat", Json::object()));
      }
      if (strokes && begin_s > 0.0 && now_s > begin_s) {
        begin_s = 0.0;
        client.send(call("feel.start", Json::object()));
      }
      if (strokes && now_s >= scan_s) {
        scan_s = now_s + kStroke_s;
        client.send(call("scan.start", Json::object()));
      }
      if (strokes && now_s >= pointer_s) {
        pointer_s = now_s + 1.0 / 60.0;
        std::array<char, 32> move{};
        const std::uint32_t magic = 0x31505341;
        ++sequence;
        const std::array<double, 3> p_m{0.008 + 0.004 * std::sin(2.0 * now_s), 0.008, now_s < 5.0 ? 0.004 : -0.002};
        std::memcpy(move.data(), &magic, 4);
        std::memcpy(move.data() + 4, &sequence, 4);
        std::memcpy(move.data() + 8, p_m.data(), 24);
        client.send(RawClient::frame(2, {move.data(), move.size()}));
      }
    }
  } catch (const std::exception& error) {
    out.failure = error.what();
  }
}

std::string address_of(const std::filesystem::path& output) {
  for (const auto start = Clock::now(); s_since(start) < 60.0;) {
    std::ifstream in(output);
    for (std::string word; in >> word;) {
      if (word.starts_with("http://") && word.find("token=") != std::string::npos) return word;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  throw Error("the studio printed no address");
}

void write_wave(const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary);
  out << "P5\n64 64\n255\n";
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column)
      out.put(static_cast<char>(static_cast<unsigned char>(100.0 + 40.0 * std::sin(0.6 * column))));
}

// A block that the board's pulled hand meets: the plane's second axis is the scene's z.
void write_block(const std::filesystem::path& file, double near_m) {
  std::ofstream out(file);
  for (const double z : {near_m, near_m + 0.1})
    for (const double y : {-0.1, 0.1})
      for (const double x : {-0.1, 0.1}) out << "v " << x << ' ' << y << ' ' << z << '\n';
  out << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

std::string last_lines(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  return text.size() > 1200 ? text.substr(text.size() - 1200) : text;
}

bool soak(double minutes, const std::filesystem::path& programs) {
  const asperity::testkit::TempDir dir;
  const std::string asperity = (programs / "asperity").string();
  // The hand lifts again and again: a point that a late machine let go of inside the block feels nothing until then.
  asperity::FakeBoardConfig hand;
  hand.lifts_every_s = 6.0;
  asperity::FakeTwoDiyBoard board(hand);
  std::filesystem::create_directory(dir / "project");
  write_wave(std::filesystem::path(dir / "project") / "wave.pgm");
  write_block(dir / "block.obj", board.p_m().y() + 0.012);
  const double duration_s = 60.0 * minutes;

  WatchedProcess record("record", {(programs / "record_soak").string(), std::to_string(minutes), dir / "recording"},
                        dir / "record.txt");
  WatchedProcess studio("studio", {asperity, "studio", dir / "project", "--port", "0", "--no-open"},
                        dir / "studio.txt");
  const std::vector<std::string> feel_words{asperity,
                                            "feel",
                                            dir / "block.obj",
                                            "--mesh-unit",
                                            "m",
                                            "--device",
                                            "2diy",
                                            "--set",
                                            "2diy.port=" + board.port(),
                                            "--set",
                                            "servo.frame.translation_m=[1e-9, 0, 0]",
                                            "--duration",
                                            "36000s"};
  auto feel = std::make_unique<WatchedProcess>("feel", feel_words, dir / "feel.txt");
  int begun_again = 0;
  const std::string address = address_of(dir / "studio.txt");
  const int port = std::stoi(address.substr(std::string("http://127.0.0.1:").size()));
  const std::string cookie = asperity::studio::session_cookie(port, address);
  std::atomic<bool> stop{false};
  std::array<Window, 3> windows;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < windows.size(); ++i)
    threads.emplace_back([&, i] { watch(port, cookie, i == 0, stop, windows[i]); });

  std::array<WatchedProcess*, 3> children{&record, &studio, feel.get()};
  std::array<std::vector<WatchedProcess::Reading>, 3> readings;
  bool well = true;
  double held = 0.0, looked = 0.0, most_N = 0.0;
  const auto start = Clock::now();
  std::printf("%8s", "min");
  for (const WatchedProcess* child : children) std::printf(" | %-6s  MiB  files  threads", child->name().c_str());
  std::printf("\n");
  for (int reading = 1; reading <= kReadings && well; ++reading) {
    while (s_since(start) < duration_s * (reading - 0.2) / kReadings) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      // A machine too busy for the loop ends the force, as it must; that is told, and it is no pass.
      if (feel->wait(0.0) >= 0) {
        std::printf("feel ended:\n%s\n", last_lines(dir / "feel.txt").c_str());
        feel = std::make_unique<WatchedProcess>("feel", feel_words, dir / "feel.txt");
        children[2] = feel.get();
        ++begun_again;
      }
      if (s_since(start) < 20.0) continue;
      const double force_N = board.force_N().norm();
      looked += 1.0;
      held += force_N > 0.1 ? 1.0 : 0.0;
      most_N = std::max(most_N, force_N);
    }
    std::printf("%8.1f", s_since(start) / 60.0);
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (children[i]->wait(0.0) >= 0) {
        std::printf("\n%s ended early:\n%s\n", children[i]->name().c_str(),
                    last_lines(dir / (children[i]->name() + ".txt")).c_str());
        well = false;
        break;
      }
      readings[i].push_back(children[i]->read());
      const auto& now = readings[i].back();
      std::printf(" | %11.1f %6d %8d", now.memory_MiB, now.descriptors, now.threads);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  const int recorded = well ? record.wait(0.1 * duration_s + 60.0) : -1;
  stop = true;
  for (std::thread& thread : threads) thread.join();
  feel->send(SIGINT);
  studio.send(SIGINT);
  feel->wait(10.0);
  studio.wait(20.0);

  std::printf("\n%s\n", last_lines(dir / "record.txt").c_str());
  if (recorded != 0) well = false;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const Window& w = windows[i];
    std::printf("window %zu: %.1f MB in %llu frames, %llu ticks of the servo, %llu rows of the probe, %llu lost%s%s\n",
                i + 1, 1e-6 * static_cast<double>(w.bytes), static_cast<unsigned long long>(w.frames),
                static_cast<unsigned long long>(w.ticks), static_cast<unsigned long long>(w.rows),
                static_cast<unsigned long long>(w.lost_rows), w.failure.empty() ? "" : "; ", w.failure.c_str());
    if (w.rows == 0 || std::getenv("HOUSE_TELL") != nullptr) std::printf("%s\n", w.scan.substr(0, 1500).c_str());
    well = well && w.failure.empty() && w.lost_rows == 0 && w.rows > 0 && w.ticks > 0 && w.errors == 0;
  }
  // A machine that stands still ends the force, and a point that comes back inside an object feels nothing until the
  // hand lifts.
  std::printf("feel: restarted %d times; force at the board in %.1f %% of the time, %.2f N at most\n%s", begun_again,
              100.0 * held / std::max(1.0, looked), most_N, last_lines(dir / "feel.txt").c_str());
  for (std::size_t i = 0; i < children.size(); ++i) {
    if (readings[i].size() < 2) continue;
    const auto& first = readings[i][1];
    const auto& last = readings[i].back();
    std::printf("%s: memory %+.1f MiB, files %+d, threads %+d after the second reading\n", children[i]->name().c_str(),
                last.memory_MiB - first.memory_MiB, last.descriptors - first.descriptors, last.threads - first.threads);
    well = well && last.memory_MiB - first.memory_MiB < kMostGrowth_MiB && last.descriptors <= first.descriptors &&
           last.threads <= first.threads;
  }
  well = well && begun_again == 0 && held > kLeastHeld * looked;
  std::printf("%s\n", well ? "passed" : "FAILED");
  return well;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto minutes = asperity::parse_double(argc > 1 ? argv[1] : "60");
    if (!minutes || !(*minutes > 0.5 && *minutes <= 600.0)) throw Error("MINUTES must be above 0.5 and at most 600");
    return soak(*minutes, std::filesystem::read_symlink("/proc/self/exe").parent_path()) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "house_soak: %s\n", error.what());
    return 1;
  }
}
