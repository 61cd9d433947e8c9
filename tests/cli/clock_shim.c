/* Preloaded into the program: CLOCK_BOOTTIME runs ahead by the nanoseconds in the file CLOCK_AHEAD, as after the
 * machine was suspended. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static const volatile int64_t* s_ahead_ns;

__attribute__((constructor)) static void look(void) {
  const char* path = getenv("CLOCK_AHEAD");
  const int file = path != NULL ? open(path, O_RDONLY | O_CLOEXEC) : -1;
  if (file < 0) return;
  void* at = mmap(NULL, sizeof *s_ahead_ns, PROT_READ, MAP_SHARED, file, 0);
  if (at != MAP_FAILED) s_ahead_ns = at;
  close(file);
}

int clock_gettime(clockid_t clock, struct timespec* out) {
  const int result = (int)syscall(SYS_clock_gettime, clock, out);
  if (result == 0 && clock == CLOCK_BOOTTIME && s_ahead_ns != NULL) {
    const int64_t ns = out->tv_nsec + *s_ahead_ns % 1000000000;
    out->tv_sec += *s_ahead_ns / 1000000000 + ns / 1000000000;
    out->tv_nsec = ns % 1000000000;
  }
  return result;
}
