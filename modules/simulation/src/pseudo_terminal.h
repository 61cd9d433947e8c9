#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace asperity {

// The near end of a raw pseudo-terminal, whose far end another program opens like a serial port.
class PseudoTerminal {
 public:
  PseudoTerminal();
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  const std::string& port() const { return port_; }
  bool has_reader() const;  // the far end is open

  // How many bytes were taken; never waits.
  std::size_t write(std::span<const std::uint8_t> bytes);
  // Appends what the far end has sent; never waits.
  void read(std::vector<std::uint8_t>& out);

 private:
  int master_ = -1;
  std::string port_;
};

}  // namespace asperity
