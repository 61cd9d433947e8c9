#pragma once

#include <string>
#include <vector>

namespace asperity {

// A function of a driver: its name, and where its address goes.
struct DriverSymbol {
  const char* name;
  void** address;
  bool required = true;
};

template <class Function>
DriverSymbol driver_symbol(const char* name, Function*& pointer, bool required = true) {
  return {name, reinterpret_cast<void**>(&pointer), required};
}

// Loads the first of `libraries` that is there and has all required symbols, and sets the addresses; those that are
// not required are null where it has them not. It is never unloaded: such drivers leave threads behind. Throws one
// Error that begins with `device` and names every library searched for with what was wrong with it.
void load_driver(const std::string& device, const std::vector<std::string>& libraries,
                 const std::vector<DriverSymbol>& symbols);

}  // namespace asperity
