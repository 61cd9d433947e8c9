#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace asperity::cli {

struct Outcome {
  int code = -1;  // the exit code, or 128 + signal
  std::string out;
  std::string err;
};

// Runs the built program with `arguments` and waits for it. No shell, no standard input.
Outcome run(const std::vector<std::string>& arguments);

// The same with a file as its standard input.
Outcome run_from(const std::filesystem::path& in, const std::vector<std::string>& arguments);

// The same, but sends `signal` after `delay`.
Outcome run_and_signal(const std::vector<std::string>& arguments, int signal, std::chrono::milliseconds delay);

// The same, with what `meddle` does to the process while it runs. It must end by itself or by that.
// Its standard output goes to `out` if that is not empty.
Outcome run_and_meddle(const std::vector<std::string>& arguments, const std::function<void(pid_t)>& meddle,
                       const std::filesystem::path& out = {});

// The program with its standard output going to `path`.
Outcome run_into(const std::filesystem::path& path, const std::vector<std::string>& arguments);

// Every file below `folder` by its relative path, with its content.
std::vector<std::pair<std::string, std::string>> contents(const std::filesystem::path& folder);

void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace asperity::cli
