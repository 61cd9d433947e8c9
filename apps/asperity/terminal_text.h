#pragma once

#include <string>
#include <string_view>

namespace asperity::app {

// Names, notes and messages in what is printed may be a stranger's. `text` with every character but line break and tab
// that changes a terminal or the order of what is read on it written as \xNN.
std::string terminal_text(std::string_view text);

// The same of JSON: in its texts such characters are escaped as \uNNNN, which reads as the same value.
std::string terminal_json(std::string_view json);

}  // namespace asperity::app
