// What reading costs as texts grow, for all that strangers send: the processor's time for n and for 16n bytes, the
// least of five, and the ratio. Fails where twice the text takes 2.5 times as long or more over these four
// doublings (39.06; the square would be 256), unless that is below a millisecond, and where one message of 600 KB takes
// 100 ms. What else runs on the machine does not count. Sixteen texts of n bytes are read for the time of one, and
// memory is not given back in between: both lengths pay the same to the kernel. Over a single doubling a cache that is
// left looks like an exponent.
//
//   json_scaling [BYTES]      125,000 if not given: up to 2 MB

#include <malloc.h>
#include <time.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/geometry/read_gltf.h"
#include "asperity/json/parse_json.h"
#include "asperity/scene/read_scene.h"
#include "asperity/studio/document.h"
#include "asperity/studio/message.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/texture/import_penn.h"

namespace {

using namespace asperity;
using Text = std::function<std::string(std::size_t bytes)>;
using Read = std::function<void(const std::string& text)>;

constexpr double kMostRatio = 2.5 * 2.5 * 2.5 * 2.5, kLeast_ms = 1.0, kMostMessage_ms = 100.0;

double processor_ms() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

// Of all texts together.
double least_ms(const Read& read, const std::vector<std::string>& texts) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5; ++i) {
    const double start_ms = processor_ms();
    for (const std::string& text : texts) {
      try {
        read(text);
      } catch (const Error&) {  // a refusal counts as reading does
      }
    }
    least = std::min(least, processor_ms() - start_ms);
  }
  return least;
}

Text repeated(std::string open, std::function<std::string(std::size_t)> one, std::string close) {
  return [=](std::size_t bytes) {
    std::string out = open;
    for (std::size_t i = 0; out.size() < bytes; ++i) out += (i > 0 ? "," : "") + one(i);
    return out + close;
  };
}

Text always(std::string open, std::string one, std::string close) {
  return repeated(
      std::move(open), [one = std::move(one)](std::size_t) { return one; }, std::move(close));
}

std::string member(std::size_t i) { return "\"key_" + std::to_string(i) + "\":0"; }

class Table {
 public:
  explicit Table(std::size_t bytes) : bytes_(bytes) {
    std::printf("%-44s %10s %10s %10s %7s\n", "", "bytes", "ms", "16n: ms", "ratio");
  }

  void row(const char* name, const Text& text, const Read& read) {
    const std::vector<std::string> sixteen(16, text(bytes_)), whole{text(16 * bytes_)};
    const double first_ms = least_ms(read, sixteen) / 16.0, second_ms = least_ms(read, whole);
    const double ratio = second_ms / first_ms;
    const bool linear = ratio < kMostRatio || second_ms < kLeast_ms;
    std::printf("%-44s %10zu %10.2f %10.2f %7.2f%s\n", name, sixteen[0].size(), first_ms, second_ms, ratio,
                linear ? "" : "  NOT LINEAR");
    good_ = good_ && linear;
  }
  void once(const char* name, const std::string& text, const Read& read, double most_ms) {
    const double time_ms = least_ms(read, {text});
    std::printf("%-44s %10zu %10.2f%s\n", name, text.size(), time_ms, time_ms < most_ms ? "" : "  TOO LONG");
    good_ = good_ && time_ms < most_ms;
  }
  bool good() const { return good_; }

 private:
  std::size_t bytes_;
  bool good_ = true;
};

int run(std::size_t bytes) {
  ::mallopt(M_MMAP_MAX, 0);
  ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  JsonLimits limits;
  limits.values = limits.keys = 100'000'000;
  const Read json = [&](const std::string& text) { parse_json(text, "text", limits); };
  const Read gltf = [](const std::string& text) { parse_gltf(text, "text"); };
  const Read penn = [](const std::string& text) { parse_penn(text, "text"); };
  const testkit::TempDir folder;
  const Read scene = [&](const std::string& text) {
    write_file(folder / "scene.json", text);
    read_scene(folder / "scene.json");
  };
  const Read project = [&](const std::string& text) {
    write_file(folder / "project.json", text);
    studio::Document document(folder / "project.json");
    document.add_section("page", Json::object(), [](const Json&) {});
    document.load();
  };
  const std::string project_head =
      R"({"format":"asperity-studio","version":1,"undo":[],"redo":[],"document":{"page":{"list":[)";
  const std::string call = R"({"id":7,"call":"document.edit","args":{"value":[)";

  Table table(bytes);
  table.row("empty objects", always("[", "{}", "]"), json);
  table.row("one wide object", repeated("{", member, "}"), json);
  table.row("objects of sixteen keys", always("[", repeated("{", member, "}")(180), "]"), json);
  table.row("nested objects", always("[", R"({"a":{"a":{"a":{"a":{}}}}})", "]"), json);
  table.row("nested lists", always("[", "[[[[[[[[]]]]]]]]", "]"), json);
  table.row("numbers", always("[", "-12.5e-3", "]"), json);
  table.row("texts", always("[", R"("a \"text\" µ")", "]"), json);
  table.row(
      "one text", [](std::size_t n) { return '"' + std::string(n, 'a') + '"'; }, json);
  table.row(
      "blank lines", [](std::size_t n) { return std::string(n, '\n') + "1"; }, json);
  table.row("glTF of empty nodes", always(R"({"asset":{"version":"2.0"},"nodes":[)", "{}", "]}"), gltf);
  table.row("scene.json of unknown keys",
            repeated(R"({"format":"asperity-scene","version":1,"mesh":"m.obj","extra":{)", member, "}}"), scene);
  table.row("the studio's project file", always(project_head, R"({"a":{}})", "]}}}"), project);
  table.row(
      "Penn XML of ends",
      [](std::size_t n) {
        std::string out;
        while (out.size() < n) out += "</";
        return out + "<";
      },
      penn);
  table.row(
      "Penn XML of tags",
      [](std::size_t n) {
        std::string out = "<modelSet>";
        while (out.size() < n) out += "<a b='/>'/>";
        return out + "</modelSet>";
      },
      penn);
  table.once(
      "a message of 199,000 empty objects", always(call, "{}", "]}}")(597'000),
      [](const std::string& text) { studio::decode_message(text, true); }, kMostMessage_ms);
  return table.good() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto bytes = argc > 1 ? parse_int64(argv[1]) : std::optional<std::int64_t>(125'000);
    if (argc > 2 || !bytes || *bytes < 1000) {
      std::fprintf(stderr, "usage: json_scaling [BYTES]\n");
      return 2;
    }
    return run(static_cast<std::size_t>(*bytes));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
