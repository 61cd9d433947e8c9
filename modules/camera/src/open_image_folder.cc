#include "asperity/camera/open_image_folder.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "asperity/base/text.h"
#include "asperity/image/read_gray_image.h"
#include "asperity/transport/byte_source.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostFiles = 1'000'000;
constexpr double kLargestFolderRate_Hz = 1e5;
constexpr std::int64_t kShortestInterval_ns = 100'000;

struct TimedFile {
  std::int64_t t_ns = 0;
  fs::path path;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The digits at the front of `text`, without leading zeros.
std::string_view take_digits(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  while (digits.size() > 1 && digits.front() == '0') digits.remove_prefix(1);
  return digits;
}

// Numbers by their value, all else by its bytes.
bool natural_less(const std::string& left, const std::string& right) {
  std::string_view a = left, b = right;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view x = take_digits(a), y = take_digits(b);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty()) return a.empty();
  return left < right;
}

bool is_image_name(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".pgm";
}

std::vector<TimedFile> times_from_names(const std::vector<fs::path>& files, const std::string& name) {
  std::vector<TimedFile> out;
  out.reserve(files.size());
  for (const fs::path& path : files) {
    const auto t_ns = parse_int64(path.stem().string());
    if (!t_ns) {
      throw Error(name + ": the name of " + printable(path.filename().string()) +
                  " is not a time in ns; give the images a rate, such as ?rate=45");
    }
    out.push_back({*t_ns, path});
  }
  std::sort(out.begin(), out.end(), [](const TimedFile& a, const TimedFile& b) { return a.t_ns < b.t_ns; });
  std::vector<double> intervals_ns;
  for (std::size_t i = 1; i < out.size(); ++i) {
    const double interval_ns = static_cast<double>(out[i].t_ns) - static_cast<double>(out[i - 1].t_ns);
    if (out[i].t_ns == out[i - 1].t_ns) {
      throw Error(name + ": " + printable(out[i - 1].path.filename().string()) + " and " +
                  printable(out[i].path.filename().string()) + " have the same time");
    }
    intervals_ns.push_back(interval_ns);
  }
  if (intervals_ns.empty()) return out;
  const auto middle = intervals_ns.begin() + static_cast<std::ptrdiff_t>(intervals_ns.size() / 2);
  std::nth_element(intervals_ns.begin(), middle, intervals_ns.end());
  if (*middle < static_cast<double>(kShortestInterval_ns)) {
    throw Error(name + ": the names are not times in ns: they would be " + std::to_string(std::llround(*middle)) +
                " ns apart; give the images a rate, such as ?rate=45");
  }
  return out;
}

class ImageListSource final : public CameraSource {
 public:
  ImageListSource(std::vector<fs::path> files, std::string name, const ImageFolderConfig& config)
      : name_(std::move(name)), rate_Hz_(config.rate_Hz) {
    if (!(rate_Hz_ >= 0.0) || rate_Hz_ > kLargestFolderRate_Hz) {
      throw Error(name_ + ": the rate " + number_text(rate_Hz_) + " Hz is not within 0 to 100000");
    }
    if (files.empty()) throw Error(name_ + ": holds no image (*.png, *.jpg, *.jpeg, *.pgm)");
    if (rate_Hz_ == 0.0) {
      files_ = times_from_names(files, name_);
      return;
    }
    files_.reserve(files.size());
    for (fs::path& path : files) {
      const double t_s = static_cast<double>(files_.size()) / rate_Hz_;
      files_.push_back({std::llround(t_s * 1e9), std::move(path)});
    }
  }

  bool read(CameraFrame& frame, std::chrono::milliseconds) override {
    if (next_ == files_.size()) throw LinkLost(name_ + ": has ended after image " + std::to_string(next_));
    const TimedFile& file = files_[next_++];
    frame.image = read_gray_image(file.path);
    frame.t_ns = file.t_ns;
    return true;
  }

  double nominal_rate_Hz() const override { return rate_Hz_; }
  std::string name() const override { return name_; }

 private:
  std::string name_;
  double rate_Hz_;
  std::vector<TimedFile> files_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<CameraSource> open_image_folder(const fs::path& folder, const ImageFolderConfig& config) {
  const std::string name = "images:" + folder.string();
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (!is_image_name(entry->path()) || !entry->is_regular_file(ignored)) continue;
    if (files.size() == kMostFiles)
      throw Error(name + ": there are more than " + std::to_string(kMostFiles) + " images");
    files.push_back(entry->path());
  }
  if (error) throw Error(name + ": cannot be read: " + error.message());
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return std::make_unique<ImageListSource>(std::move(files), name, config);
}

std::unique_ptr<CameraSource> open_image_list(std::vector<fs::path> files, const ImageFolderConfig& config) {
  return std::make_unique<ImageListSource>(std::move(files), "images", config);
}

}  // namespace asperity
