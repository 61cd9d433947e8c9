#include "image_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity::app {

namespace fs = std::filesystem;

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_image(const fs::path& file) {
  std::string end = file.extension().string();
  std::transform(end.begin(), end.end(), end.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return end == ".png" || end == ".jpg" || end == ".jpeg" || end == ".pgm" || end == ".ppm";
}

// img9 before img10.
bool by_number(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [](const std::string& text, std::size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const std::size_t first = at;
      while (at < text.size() && is_digit(text[at])) ++at;
      return text.substr(first, at - first);
    };
    const std::string x = number(a, i), y = number(b, j);
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
  }
  return a.size() - i < b.size() - j;
}

std::vector<fs::path> images_in(const fs::path& folder, std::size_t most) {
  std::vector<fs::path> out;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file() || !is_image(entry.path())) continue;
    if (out.size() == most) throw Error(fmt::format("{}: more than {} images", printable(folder.string(), 200), most));
    out.push_back(entry.path());
  }
  if (out.empty()) throw Error(printable(folder.string(), 200) + ": no PNG, JPEG, PGM or PPM image in this folder");
  std::sort(out.begin(), out.end(), [](const fs::path& a, const fs::path& b) {
    const std::string x = a.filename().string(), y = b.filename().string();
    return by_number(x, y) || (!by_number(y, x) && x < y);
  });
  return out;
}

}  // namespace

std::vector<fs::path> image_files(const std::vector<std::string>& paths, std::size_t most) {
  std::vector<fs::path> out;
  for (const std::string& path : paths) {
    std::error_code failure;
    if (fs::is_directory(path, failure)) {
      const std::vector<fs::path> inside = images_in(path, most);
      out.insert(out.end(), inside.begin(), inside.end());
    } else if (fs::exists(path, failure)) {
      out.emplace_back(path);
    } else {
      throw Error(printable(path, 200) + ": no such file or folder");
    }
    if (out.size() > most) throw Error(fmt::format("more than {} images", most));
  }
  return out;
}

}  // namespace asperity::app
