#include "asperity/link/open_capture.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <csignal>
#include <fstream>
#include <memory>

#include "asperity/base/csv.h"
#include "asperity/link/capture_to_file.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct Piece {
  Bytes bytes;
  std::int64_t arrival_ns = 0;
  bool operator==(const Piece&) const = default;
};

// Gives pieces that are known, then is lost.
class KnownSource : public ByteSource {
 public:
  explicit KnownSource(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}
  Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds) override {
    if (next_ == pieces_.size()) throw LinkLost("known: end");
    const Piece& piece = pieces_[next_++];
    std::copy(piece.bytes.begin(), piece.bytes.end(), into.begin());
    return {piece.bytes.size(), piece.arrival_ns};
  }
  bool write(std::span<const std::uint8_t> bytes) override { return !bytes.empty(); }
  std::string name() const override { return "known"; }

 private:
  std::vector<Piece> pieces_;
  std::size_t next_ = 0;
};

std::vector<Piece> read_all(ByteSource& source, std::size_t room = 100'000) {
  std::vector<Piece> out;
  Bytes buffer(room);
  try {
    while (true) {
      const Arrival arrival = source.read(buffer, 1s);
      if (arrival.count == 0) continue;
      out.push_back(
          {{buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(arrival.count)}, arrival.arrival_ns});
    }
  } catch (const LinkLost&) {
  }
  return out;
}

Bytes joined(const std::vector<Piece>& pieces) {
  Bytes out;
  for (const Piece& piece : pieces) out.insert(out.end(), piece.bytes.begin(), piece.bytes.end());
  return out;
}

void write_bytes(const std::filesystem::path& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

const std::vector<Piece> kPieces{
    {{1, 2, 3}, 5'000}, {{}, 5'500}, {{0, 255}, 6'000'000}, {{4}, 6'000'000}, {Bytes(300, 9), 9'000'000'000}};

const auto failure = std::make_shared<CaptureFailure>();

TEST(Capture, IsReplayedAsItCame) {
  const testkit::TempDir dir;
  {
    const auto source = capture_to_file(std::make_unique<KnownSource>(kPieces), dir / "c.bin", failure);
    EXPECT_EQ(source->name(), "known");
    EXPECT_TRUE(source->write(Bytes{1}));
    Bytes buffer(1000);
    for (const Piece& piece : kPieces) EXPECT_EQ(source->read(buffer, 1s).count, piece.bytes.size());
    EXPECT_THROW(source->read(buffer, 1s), LinkLost);
  }
  EXPECT_EQ(read_file(dir / "c.bin.arrivals.csv", 1000),
            "bytes,arrival_ns\n3,5000\n2,6000000\n1,6000000\n300,9000000000\n");
  const auto replay = open_capture(dir / "c.bin", {.start_ns = 70});
  const auto pieces = read_all(*replay);
  ASSERT_EQ(pieces.size(), 4u);
  EXPECT_EQ(pieces[0], (Piece{{1, 2, 3}, 70}));
  EXPECT_EQ(pieces[1], (Piece{{0, 255}, 70 + 5'995'000}));
  EXPECT_EQ(pieces[2], (Piece{{4}, 70 + 5'995'000}));
  EXPECT_EQ(pieces[3].arrival_ns, 70 + 8'999'995'000);
  EXPECT_FALSE(replay->write(Bytes{1}));
  EXPECT_THAT(
      [&] {
        read_all(*replay);
        replay->read(std::span<std::uint8_t>(), 1s);
        Bytes room(4);
        replay->read(room, 1s);
      },
      ThrowsMessage<LinkLost>(HasSubstr("c.bin: is at its end")));
}

// What the disk refuses is no fault of the probe: its bytes go on, and the reason is told beside them.
TEST(Capture, ADiskThatIsFullEndsTheCaptureOnly) {
  const testkit::TempDir dir;
  const auto refused = std::make_shared<CaptureFailure>();
  const auto source = capture_to_file(std::make_unique<KnownSource>(kPieces), dir / "c.bin", refused);
  EXPECT_EQ(refused->reason(), "");
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{100, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::vector<Piece> came = read_all(*source);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(joined(came), joined(kPieces));
  EXPECT_THAT(refused->reason(), AllOf(HasSubstr((dir / "c.bin").string()), HasSubstr("File too large")));
}

TEST(Capture, AtAByteRate) {
  const testkit::TempDir dir;
  Bytes bytes(1000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i);
  write_bytes(dir / "c.bin", bytes);
  const CaptureConfig config{.bytes_per_s = 10'000.0, .start_ns = 1'000};
  const auto pieces = read_all(*open_capture(dir / "c.bin", config));
  EXPECT_EQ(joined(pieces), bytes);
  EXPECT_EQ(pieces.front(), (Piece{Bytes(bytes.begin(), bytes.begin() + 10), 1'000 + 1'000'000}));
  EXPECT_EQ(pieces.back().arrival_ns, 1'000 + 100'000'000);
  // A small room divides pieces and leaves their times.
  const auto small = read_all(*open_capture(dir / "c.bin", config), 3);
  EXPECT_EQ(joined(small), bytes);
  EXPECT_EQ(small[3].arrival_ns, 1'000 + 1'000'000);
  EXPECT_EQ(small[4].arrival_ns, 1'000 + 2'000'000);
}

TEST(Capture, InRealTimeNothingComesBeforeItIsDue) {
  const testkit::TempDir dir;
  write_bytes(dir / "c.bin", Bytes(2, 7));
  const auto source = open_capture(dir / "c.bin", {.bytes_per_s = 20.0, .real_time = true});
  Bytes buffer(10);
  const auto begin = std::chrono::steady_clock::now();
  while (source->read(buffer, 10ms).count == 0) EXPECT_LT(std::chrono::steady_clock::now() - begin, 20s);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 50ms);
}

TEST(Capture, WhatCannotBeReplayedIsRefused) {
  const testkit::TempDir dir;
  EXPECT_THAT([&] { open_capture(dir / "absent", {.bytes_per_s = 1.0}); }, ThrowsMessage<Error>(HasSubstr("absent")));
  EXPECT_THAT([&] { open_capture(dir.path(), {.bytes_per_s = 1.0}); },
              ThrowsMessage<Error>(HasSubstr("cannot be read")));
  write_bytes(dir / "c.bin", {1, 2});
  EXPECT_THAT([&] { open_capture(dir / "c.bin", {}); },
              ThrowsMessage<Error>(AllOf(HasSubstr("c.bin.arrivals.csv"), HasSubstr("give their rate"))));
  EXPECT_THROW(open_capture(dir / "c.bin", {.bytes_per_s = -1.0}), Error);
  for (const char* text : {"bytes,arrival_ns\n0,5\n", "bytes,arrival_ns\n1,x\n", "bytes,arrival_ns\n1,5\n1,4\n", "a\n",
                           "bytes,arrival_ns\n1,9000000000000000000\n", "bytes,arrival_ns\n99999999999999999999,1\n"}) {
    std::ofstream(dir / "c.bin.arrivals.csv") << text;
    EXPECT_THAT([&] { open_capture(dir / "c.bin", {}); }, ThrowsMessage<Error>(HasSubstr("c.bin.arrivals.csv")))
        << text;
  }
  EXPECT_THAT([&] { capture_to_file(std::make_unique<KnownSource>(kPieces), dir / "c.bin", failure); },
              ThrowsMessage<Error>(HasSubstr("exists already")));
  EXPECT_THAT([&] { capture_to_file(std::make_unique<KnownSource>(kPieces), dir / "no/c.bin", failure); },
              ThrowsMessage<Error>(HasSubstr("cannot be written")));
}

// The arrivals say more than there is: the capturing process died in between.
TEST(Capture, BytesThatAreMissingEndIt) {
  const testkit::TempDir dir;
  write_bytes(dir / "c.bin", {1, 2, 3});
  std::ofstream(dir / "c.bin.arrivals.csv") << "bytes,arrival_ns\n2,5\n4,6\n7,8\n";
  EXPECT_EQ(joined(read_all(*open_capture(dir / "c.bin", {}))), Bytes({1, 2, 3}));
}

}  // namespace
}  // namespace asperity
