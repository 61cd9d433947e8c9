// asperity_openhaptics: the process that runs OpenHaptics' driver for a program (openhaptics_device.h), which starts
// it. It ends the force when the program is gone, stopped or silent, and itself when the driver does not return.
#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <climits>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <exception>
#include <optional>

#include "asperity/device/supervisor.h"
#include "hd_mailbox.h"
#include "hd_server.h"
#include "real_time.h"

namespace {

using asperity::boot_now_ns;
using asperity::hd::Mailbox;

constexpr int kRound_ms = 10;   // between two looks at the driver
constexpr int kMostRounds = 5;  // that it must have missed besides: this process may itself not have been run
constexpr int kPriority = 71;   // real-time: above the threads that it watches
// After that the kernel ends this process. The program gives up opening after 30 s; one that is gone cannot.
constexpr unsigned kOpensWithin_s = 35, kEndsWithin_s = 2;

Mailbox* find_mailbox() {
  struct stat status {};
  if (::fstat(asperity::hd::kMailboxFile, &status) != 0 || status.st_size != off_t{sizeof(Mailbox)}) return nullptr;
  void* const page = ::mmap(nullptr, sizeof(Mailbox), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE,
                            asperity::hd::kMailboxFile, 0);
  if (page == MAP_FAILED) return nullptr;
  auto* const mailbox = static_cast<Mailbox*>(page);
  return mailbox->version == Mailbox::kVersion ? mailbox : nullptr;
}

// Returns when the program wants the end, or is gone.
void watch(Mailbox& mailbox) {
  sched_param priority{};
  priority.sched_priority = kPriority;
  ::sched_setscheduler(0, SCHED_FIFO, &priority);  // where it is not permitted, as others are
  std::uint64_t frames = 0;
  std::int64_t moved_ns = boot_now_ns();
  int rounds = 0;
  for (;;) {
    pollfd line{.fd = asperity::hd::kLineFile, .events = POLLIN, .revents = 0};
    if (::poll(&line, 1, kRound_ms) > 0) return;
    const std::int64_t now_ns = boot_now_ns();
    if (const std::uint64_t newest = mailbox.frames.load(); newest != frames) {
      frames = newest;
      moved_ns = now_ns;
      rounds = 0;
    }
    if (++rounds <= kMostRounds || static_cast<double>(now_ns - moved_ns) * 1e-9 <= mailbox.hang_after_s) continue;
    // Nothing else ends a call of the driver that does not return; what the device does then is the driver's affair.
    mailbox.hung.store(true);
    ::_exit(3);
  }
}

}  // namespace

int main() {
  Mailbox* const mailbox = find_mailbox();
  if (mailbox == nullptr) return 2;  // not started by a program of ours
  ::close_range(asperity::hd::kLineFile + 1, UINT_MAX, 0);
  // The program's end decides.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) ::signal(signal, SIG_IGN);
  const asperity::MemoryLock locked(true);
  std::optional<asperity::hd::Server> server;
  ::alarm(kOpensWithin_s);
  try {
    server.emplace(*mailbox);
  } catch (const std::exception& error) {
    std::strncpy(mailbox->refusal.data(), error.what(), mailbox->refusal.size() - 1);
    mailbox->state.store(Mailbox::State::kRefused);
    return 1;
  }
  ::alarm(0);
  mailbox->state.store(Mailbox::State::kOpen);
  watch(*mailbox);
  ::alarm(kEndsWithin_s);
  server->close();
  return 0;
}
