#pragma once

#include <filesystem>
#include <string>

namespace asperity::studio {

// Opens the user's browser at an address whose fragment is a secret. The address is in a file that only the user
// can read and that leads on to it, for other users see the arguments of programs. The file goes with this object.
class OpenedBrowser {
 public:
  // Without a screen, xdg-open or a folder for the file, nothing happens.
  explicit OpenedBrowser(const std::string& address) noexcept;
  ~OpenedBrowser();
  OpenedBrowser(const OpenedBrowser&) = delete;
  OpenedBrowser& operator=(const OpenedBrowser&) = delete;

 private:
  std::filesystem::path file_;
};

}  // namespace asperity::studio
