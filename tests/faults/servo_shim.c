/* Preloaded into the program: counts what the servo thread may not do. The servo thread is the one that waits for
 * absolute times of CLOCK_MONOTONIC; it is counted from its SERVO_FROM-th wait on (200: it has warmed up by then) to
 * its last one. At the end SERVO_COUNTS=FILE gets: waits, allocations (malloc, calloc, realloc, aligned_alloc,
 * posix_memalign, and free), mmap and munmap, mutex locks (also trylock), page faults of that
 * thread; and every SERVO_EVERY-th wait what there is so far. With SERVO_NO_LOCK set mlockall fails. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

typedef struct {
  long waits, allocations, maps, locks, faults;
} counts;

static __thread counts s_now; /* of this thread, since it began to be counted */
static __thread int s_counting;
static __thread long s_all_waits, s_faults_before;
static counts s_told;   /* of the thread that waited most */
static int s_file = -1; /* SERVO_COUNTS, open while there is something to count */

/* glibc's own, which need no looking up: dlsym itself allocates. */
extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);
extern void __libc_free(void*);

static void count_allocation(void) {
  if (s_counting) ++s_now.allocations;
}
void* malloc(size_t size) {
  count_allocation();
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  count_allocation();
  return __libc_calloc(count, size);
}
void* realloc(void* block, size_t size) {
  count_allocation();
  return __libc_realloc(block, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  count_allocation();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, size_t alignment, size_t size) {
  count_allocation();
  *out = __libc_memalign(alignment, size);
  return *out != NULL ? 0 : ENOMEM;
}
void free(void* block) {
  if (block != NULL) count_allocation();
  __libc_free(block);
}
void* mmap(void* at, size_t size, int protection, int flags, int file, off_t offset) {
  if (s_counting) ++s_now.maps;
  return (void*)syscall(SYS_mmap, at, size, protection, flags, file, offset);
}
int munmap(void* at, size_t size) {
  if (s_counting) ++s_now.maps;
  return (int)syscall(SYS_munmap, at, size);
}

int mlockall(int flags) {
  if (getenv("SERVO_NO_LOCK") == NULL) return (int)syscall(SYS_mlockall, flags);
  errno = ENOMEM;
  return -1;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define COUNTED_LOCK(name)               \
  int name(pthread_mutex_t* mutex) {     \
    static __typeof__(&name) real;       \
    if (real == NULL) real = REAL(name); \
    if (s_counting) ++s_now.locks;       \
    return real(mutex);                  \
  }
COUNTED_LOCK(pthread_mutex_lock)
COUNTED_LOCK(pthread_mutex_trylock)

static long page_faults(void) {
  struct rusage usage;
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

enum { SERVO_EVERY = 32 };

static void open_counts(void) {
  const char* path = getenv("SERVO_COUNTS");
  if (path != NULL && s_file < 0) s_file = (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
}

/* Always as long, so that each replaces the one before. */
static void write_counts(const counts* now) {
  char line[160];
  const int length = snprintf(line, sizeof line, "%12ld %12ld %12ld %12ld %12ld\n", now->waits, now->allocations,
                              now->maps, now->locks, now->faults);
  syscall(SYS_pwrite64, s_file, line, (size_t)length, (off_t)0);
}

int clock_nanosleep(clockid_t clock, int flags, const struct timespec* until, struct timespec* left) {
  static __typeof__(&clock_nanosleep) real;
  static long from;
  if (real == NULL) {
    from = getenv("SERVO_FROM") != NULL ? atol(getenv("SERVO_FROM")) : 200;
    real = REAL(clock_nanosleep);
  }
  if (clock == CLOCK_MONOTONIC && flags == TIMER_ABSTIME) {
    if (s_counting) {
      ++s_now.waits;
      s_now.faults = page_faults() - s_faults_before;
      /* Told as of this wait: what the thread does after its last one is its end. */
      if (s_now.waits > s_told.waits) {
        s_told = s_now;
        if (s_now.waits % SERVO_EVERY == 0) write_counts(&s_told);
      }
    } else if (++s_all_waits == from) {
      open_counts();
      s_faults_before = page_faults();
      s_counting = 1;
    }
  }
  return real(clock, flags, until, left);
}

__attribute__((destructor)) static void tell(void) {
  open_counts();
  if (s_file >= 0) write_counts(&s_told);
}
