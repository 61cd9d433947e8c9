#pragma once

#include <memory>
#include <string>
#include <vector>

namespace asperity {

// A gamepad of SDL's own that is not there: it notes how its motors are driven. Any thread.
class VirtualGamepad {
 public:
  explicit VirtualGamepad(const std::string& name, bool rumbles = true);
  ~VirtualGamepad();

  struct Command {
    double low = 0.0, high = 0.0;  // 0 to 1
    double t_s = 0.0;
  };
  std::vector<Command> commands() const;
  Command now() const;  // the last command
  void unplug();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace asperity
