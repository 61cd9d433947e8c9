#include "asperity/session/interrupt.h"

#include <pthread.h>
#include <unistd.h>
#include <csignal>

#include <atomic>
#include <chrono>
#include <thread>

#include "asperity/base/output.h"

namespace asperity {

namespace {

std::atomic<int> signal_seen{0};
std::atomic<bool> stop_asked{false};
std::atomic<int> forces_held{0};
std::atomic<int> finishes_held{0};

void wait_for_zero_force() {
  constexpr auto kStep = std::chrono::milliseconds(2);
  constexpr auto kLongest = std::chrono::seconds(2);
  for (auto waited = std::chrono::milliseconds(0); forces_held > 0 && waited < kLongest; waited += kStep) {
    std::this_thread::sleep_for(kStep);
  }
}

// A second for the program to end; a minute while something is brought to its end, and a second from then on. A second
// signal ends it.
void wait_for_the_end(const sigset_t& set) {
  constexpr int kMostFinish_s = 60;
  const timespec second{1, 0};
  for (int waited_s = 0; waited_s < kMostFinish_s; ++waited_s) {
    const bool held = finishes_held > 0;
    if (sigtimedwait(&set, nullptr, &second) > 0 || (!held && finishes_held == 0)) return;
  }
}

}  // namespace

void watch_interrupts(void (*say)(std::string_view)) {
  // A reader that closes the pipe shows up as a failed write, not as a death with output half-written.
  // Nor does a limit on the size of files.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  sigset_t set;
  sigemptyset(&set);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP}) {
    // A shell's background job has SIGINT ignored, nohup SIGHUP: that stays so.
    struct sigaction current {};
    sigaction(number, nullptr, &current);
    if (current.sa_handler != SIG_IGN) sigaddset(&set, number);
  }
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  std::thread([set, say] {
    int number = 0;
    for (;;) {
      if (sigwait(&set, &number) != 0) return;
      if (number != SIGTSTP || forces_held > 0) break;
      ::kill(::getpid(), SIGSTOP);  // without a force a terminal may stop us as it stops anybody
    }
    signal_seen = number;
    stop_asked = true;
    wait_for_the_end(set);
    wait_for_zero_force();
    remove_unfinished_output();
    say(interrupted_text());
    ::_exit(128 + number);
  }).detach();
}

ForceHold::ForceHold() { ++forces_held; }
ForceHold::~ForceHold() { --forces_held; }

FinishHold::FinishHold() { ++finishes_held; }
FinishHold::~FinishHold() { --finishes_held; }

void command_ended() { ++finishes_held; }

std::string interrupted_text() {
  const std::string kept = outputs_in_place();
  return kept.empty() ? "interrupted; nothing was written" : "interrupted; what was written before stays: " + kept;
}

bool interrupted() { return signal_seen != 0; }

const std::atomic<bool>& interrupt_flag() { return stop_asked; }

int interrupt_exit_code() { return 128 + signal_seen; }

}  // namespace asperity
