#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace asperity {

// A function of a shared library: its name, and where its address goes.
struct LibrarySymbol {
  const char* name;
  void** address;
  bool required = true;
};

template <class Function>
LibrarySymbol library_symbol(const char* name, Function*& pointer, bool required = true) {
  return {name, reinterpret_cast<void**>(&pointer), required};
}

// Loads the first of `libraries` that is there and has all required symbols, and sets the addresses; those that are
// not required are null where it has them not. It is never unloaded: drivers leave threads behind. Throws one
// Error that begins with `what` ("… was not found") and names every library searched for and why it was not usable.
void load_library(const std::string& what, const std::vector<std::string>& libraries,
                  const std::vector<LibrarySymbol>& symbols);

// Where a library of this program's own is looked for: in ../lib/asperity beside the program's folder (installed), then
// in the program's folder (built). Neither the environment nor a file that is read has a say in it.
std::vector<std::string> own_library_paths(const std::string& name);

// For a program elsewhere that is linked to these modules: its own libraries are in `folder`. Before the first use.
void set_own_library_folder(std::filesystem::path folder);

}  // namespace asperity
