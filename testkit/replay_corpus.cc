// Runs a fuzz target over every file of the folders given, as it is and with seeded damage, for compilers without
// libFuzzer:
//   fuzz_NAME FOLDER… [--damages N]     N damaged copies of each file, 12 unless given
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kLargestDamaged_bytes = 64 * 1024;

// One to four bits, bytes, pieces or numbers of `bytes` changed. std::mt19937 gives the same everywhere.
Bytes damaged(Bytes bytes, std::mt19937& random) {
  constexpr std::string_view kWords[] = {"1e308", "-1e308", "1e-320",      "nan", "inf", "99999999999999999999",
                                         "null",  "\"\"",   "{\"a\":[[[[", ",",   "\n",  "\xE2\x80\xAE"};
  const auto below = [&random](std::size_t most) { return most == 0 ? 0 : random() % most; };
  for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = below(bytes.size());
    const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const std::size_t length = 1 + below(std::min<std::size_t>(bytes.size() - at, 64));
    const auto end = place + static_cast<std::ptrdiff_t>(length);
    switch (below(6)) {
      case 0:
        *place ^= static_cast<std::uint8_t>(1U << below(8));
        break;
      case 1:
        *place = static_cast<std::uint8_t>(random());
        break;
      case 2:
        bytes.erase(place, end);
        break;
      case 3:
        bytes.resize(at);
        break;
      case 4: {
        const Bytes piece(place, end);
        const auto other = static_cast<std::ptrdiff_t>(below(bytes.size()));
        bytes.insert(bytes.begin() + other, piece.begin(), piece.end());
        break;
      }
      default: {
        const std::string_view word = kWords[below(std::size(kWords))];
        bytes.insert(place, word.begin(), word.end());
      }
    }
  }
  return bytes;
}

// At the end of a buffer of its own size, so that a sanitizer sees a read behind it.
void run(const Bytes& bytes) { LLVMFuzzerTestOneInput(bytes.data(), bytes.size()); }

}  // namespace

int main(int argc, char** argv) {
  int files = 0, damages = 0;
  std::vector<std::filesystem::path> paths;
  std::size_t damages_each = 12;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--damages" && i + 1 < argc) {
      damages_each = std::strtoul(argv[++i], nullptr, 10);
      continue;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i])) {
      if (entry.is_regular_file()) paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  std::mt19937 random(1);
  for (const std::filesystem::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    const Bytes bytes((std::istreambuf_iterator<char>(file)), {});
    run(bytes);
    ++files;
    if (bytes.size() > kLargestDamaged_bytes) continue;
    for (std::size_t k = 0; k < damages_each; ++k, ++damages) run(damaged(bytes, random));
  }
  std::printf("%d inputs replayed, %d damaged ones\n", files, damages);
  return files > 0 ? 0 : 1;
}
