/* Preloaded into the program: one call of its that writes below a folder fails, or one that takes memory.
 *   FAULT_ROOT=FOLDER       calls on files below it are counted (absolute)
 *   FAULT_AT=N              the Nth of them fails with EIO, from 1; 0: none
 *   FAULT_FROM=1            all from the Nth on fail with ENOSPC, as on a full disk, but those that take no room
 *   FAULT_NO_EXCHANGE=1     two names cannot be exchanged, as on NFS, vfat and many of FUSE (EINVAL)
 *   FAULT_MALLOC=N          the Nth call of malloc, calloc or realloc after main() began gives none
 *   FAULT_COUNTS=FILE       at the end: how many calls there were of both kinds
 * Counted are open and fopen, write, writev, pwrite, fsync, fdatasync, sendfile, ftruncate, rename, link and mkdir, and
 * of those that take no room opendir, readdir, unlink, remove and rmdir, and opening for reading. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long s_calls, s_allocations;
static long s_at = -1, s_malloc = -1;
static int s_from, s_no_exchange, s_in_main;
static char s_root[PATH_MAX], s_counts[PATH_MAX];
static size_t s_root_length;

static void note(const char* what, const char* path, long number) {
  if (getenv("FAULT_TRACE") == NULL) return;
  char line[PATH_MAX + 100];
  const int count = snprintf(line, sizeof line, "%ld %s %s\n", number, what, path);
  if (count > 0) syscall(SYS_write, 2, line, (size_t)count);
}

static void read_settings(void) {
  const char* root = getenv("FAULT_ROOT");
  if (root != NULL && strlen(root) < sizeof s_root) strcpy(s_root, root);
  s_root_length = strlen(s_root);
  const char* counts = getenv("FAULT_COUNTS");
  if (counts != NULL && strlen(counts) < sizeof s_counts) strcpy(s_counts, counts);
  s_at = getenv("FAULT_AT") != NULL ? atol(getenv("FAULT_AT")) : 0;
  s_malloc = getenv("FAULT_MALLOC") != NULL ? atol(getenv("FAULT_MALLOC")) : 0;
  s_from = getenv("FAULT_FROM") != NULL;
  s_no_exchange = getenv("FAULT_NO_EXCHANGE") != NULL;
}

static int is_ours(const char* path) {
  char whole[PATH_MAX];
  if (s_at < 0) read_settings();
  if (s_root_length == 0) return 0;
  if (path[0] != '/') {
    if (getcwd(whole, sizeof whole) == NULL || strlen(whole) + strlen(path) + 2 > sizeof whole) return 0;
    strcat(whole, "/");
    strcat(whole, path);
    path = whole;
  }
  return strncmp(path, s_root, s_root_length) == 0;
}

static int is_ours_file(int file, char* path) {
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t count = readlink(link, path, PATH_MAX - 1);
  if (count <= 0) return 0;
  path[count] = '\0';
  return is_ours(path);
}

/* 1 with errno set if this call is to fail. */
static int fails(const char* what, const char* path) {
  const long number = atomic_fetch_add(&s_calls, 1) + 1;
  note(what, path, number);
  if (s_at <= 0 || number < s_at || (number > s_at && !s_from)) return 0;
  errno = s_from ? ENOSPC : EIO;
  return 1;
}

/* The same of a call that a full disk does not refuse. */
static int fails_without_room(const char* what, const char* path) {
  const long number = atomic_fetch_add(&s_calls, 1) + 1;
  note(what, path, number);
  if (s_from || s_at <= 0 || number != s_at) return 0;
  errno = EIO;
  return 1;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static int open_it(const char* path, int flags, mode_t mode) {
  static __typeof__(&open) real;
  if (real == NULL) real = REAL(open);
  if (is_ours(path)) {
    const int writes = (flags & O_ACCMODE) != O_RDONLY;
    if (writes ? fails("open", path) : fails_without_room("open to read", path)) return -1;
  }
  return real(path, flags, mode);
}
int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = (mode_t)va_arg(list, unsigned);
  va_end(list);
  return open_it(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = (mode_t)va_arg(list, unsigned);
  va_end(list);
  return open_it(path, flags, mode);
}
static int fopen_fails(const char* path, const char* mode) {
  if (!is_ours(path)) return 0;
  return strpbrk(mode, "wa+") != NULL ? fails("fopen", path) : fails_without_room("fopen to read", path);
}
FILE* fopen(const char* path, const char* mode) {
  if (fopen_fails(path, mode)) return NULL;
  return REAL(fopen)(path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
  if (fopen_fails(path, mode)) return NULL;
  return REAL(fopen64)(path, mode);
}
ssize_t write(int file, const void* bytes, size_t count) {
  char path[PATH_MAX];
  if (is_ours_file(file, path) && fails("write", path)) return -1;
  return REAL(write)(file, bytes, count);
}
ssize_t writev(int file, const struct iovec* pieces, int count) {
  char path[PATH_MAX];
  if (is_ours_file(file, path) && fails("writev", path)) return -1;
  return REAL(writev)(file, pieces, count);
}
ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  char path[PATH_MAX];
  if (is_ours_file(file, path) && fails("pwrite", path)) return -1;
  return REAL(pwrite)(file, bytes, count, at);
}
int fsync(int file) {
  char path[PATH_MAX];
  if (is_ours_file(file, path) && fails("fsync", path)) return -1;
  return REAL(fsync)(file);
}
int fdatasync(int file) {
  char path[PATH_MAX];
  if (is_ours_file(file, path) && fails("fdatasync", path)) return -1;
  return REAL(fdatasync)(file);
}
int rename(const char* from, const char* to) {
  if (is_ours(to) && fails("rename", to)) return -1;
  return REAL(rename)(from, to);
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  if (s_no_exchange && (flags & RENAME_EXCHANGE) != 0 && is_ours(to)) return errno = EINVAL, -1;
  if (is_ours(to) && fails("renameat2", to)) return -1;
  return REAL(renameat2)(from_folder, from, to_folder, to, flags);
}
int mkdir(const char* path, mode_t mode) {
  if (is_ours(path) && fails("mkdir", path)) return -1;
  return REAL(mkdir)(path, mode);
}
int link(const char* from, const char* to) {
  if (is_ours(to) && fails("link", to)) return -1;
  return REAL(link)(from, to);
}
int ftruncate(int file, off_t length) {
  char path[PATH_MAX];
  if (is_ours_file(file, path) && fails("ftruncate", path)) return -1;
  return REAL(ftruncate)(file, length);
}
int unlink(const char* path) {
  if (is_ours(path) && fails_without_room("unlink", path)) return -1;
  return REAL(unlink)(path);
}
int remove(const char* path) {
  if (is_ours(path) && fails_without_room("remove", path)) return -1;
  return REAL(remove)(path);
}
ssize_t sendfile(int to, int from, off_t* at, size_t count) {
  char path[PATH_MAX];
  if (is_ours_file(to, path) && fails("sendfile", path)) return -1;
  return REAL(sendfile)(to, from, at, count);
}
int rmdir(const char* path) {
  if (is_ours(path) && fails_without_room("rmdir", path)) return -1;
  return REAL(rmdir)(path);
}
/* A name in a folder that is open, as libstdc++ removes a tree. */
static int is_ours_below(int folder, const char* name, char* whole) {
  if (folder == AT_FDCWD || name[0] == '/') {
    snprintf(whole, PATH_MAX, "%s", name);
    return is_ours(name);
  }
  if (!is_ours_file(folder, whole)) return 0;
  const size_t length = strlen(whole);
  snprintf(whole + length, PATH_MAX - length, "/%s", name);
  return 1;
}
int unlinkat(int folder, const char* name, int flags) {
  char path[PATH_MAX];
  if (is_ours_below(folder, name, path) && fails_without_room("unlinkat", path)) return -1;
  return REAL(unlinkat)(folder, name, flags);
}
DIR* opendir(const char* path) {
  if (is_ours(path) && fails_without_room("opendir", path)) return NULL;
  return REAL(opendir)(path);
}
int openat(int folder, const char* name, int flags, ...) {
  char path[PATH_MAX];
  va_list list;
  va_start(list, flags);
  const mode_t mode = (mode_t)va_arg(list, unsigned);
  va_end(list);
  if (is_ours_below(folder, name, path)) {
    const int writes = (flags & O_ACCMODE) != O_RDONLY;
    if (writes ? fails("openat", path) : fails_without_room("openat to read", path)) return -1;
  }
  return REAL(openat)(folder, name, flags, mode);
}
struct dirent* readdir(DIR* folder) {
  char path[PATH_MAX];
  if (is_ours_file(dirfd(folder), path) && fails_without_room("readdir", path)) return NULL;
  return REAL(readdir)(folder);
}
struct dirent64* readdir64(DIR* folder) {
  char path[PATH_MAX];
  if (is_ours_file(dirfd(folder), path) && fails_without_room("readdir", path)) return NULL;
  return REAL(readdir64)(folder);
}

/* Memory. dlsym itself may ask for some, before the real one is known. */
static void* (*s_real_malloc)(size_t);
static void* (*s_real_calloc)(size_t, size_t);
static void* (*s_real_realloc)(void*, size_t);
static void (*s_real_free)(void*);
static char s_early[65536];
static size_t s_early_used;

static void* early(size_t size) {
  const size_t begin = (s_early_used + 15) & ~(size_t)15;
  if (begin + size > sizeof s_early) return NULL;
  s_early_used = begin + size;
  return s_early + begin;
}
static int is_early(const void* block) {
  return (const char*)block >= s_early && (const char*)block < s_early + sizeof s_early;
}
static int find_real(void) {
  static int looking;
  if (s_real_malloc != NULL) return 1;
  if (looking) return 0;
  looking = 1;
  s_real_calloc = REAL(calloc);
  s_real_realloc = REAL(realloc);
  s_real_free = REAL(free);
  s_real_malloc = REAL(malloc);
  looking = 0;
  return 1;
}
static int runs_out(void) {
  if (!s_in_main) return 0;
  return atomic_fetch_add(&s_allocations, 1) + 1 == s_malloc ? (errno = ENOMEM, 1) : 0;
}
void* malloc(size_t size) {
  if (!find_real()) return early(size);
  return runs_out() ? NULL : s_real_malloc(size);
}
void* calloc(size_t count, size_t size) {
  if (!find_real()) return early(count * size); /* zero as it is */
  return runs_out() ? NULL : s_real_calloc(count, size);
}
void* realloc(void* block, size_t size) {
  if (!find_real() || is_early(block)) {
    void* out = find_real() ? s_real_malloc(size) : early(size);
    if (out != NULL && block != NULL) {
      const size_t known = (size_t)(s_early + sizeof s_early - (char*)block);
      memcpy(out, block, size < known ? size : known);
    }
    return out;
  }
  return runs_out() ? NULL : s_real_realloc(block, size);
}
void free(void* block) {
  if (block == NULL || is_early(block)) return;
  if (find_real()) s_real_free(block);
}

static int (*s_main)(int, char**, char**);
static int counted_main(int count, char** words, char** environment) {
  if (s_at < 0) read_settings();
  s_in_main = 1;
  return s_main(count, words, environment);
}
int __libc_start_main(int (*program)(int, char**, char**), int count, char** words, void (*init)(void),
                      void (*fini)(void), void (*linker_fini)(void), void* stack) {
  __typeof__(&__libc_start_main) real = REAL(__libc_start_main);
  s_main = program;
  return real(counted_main, count, words, init, fini, linker_fini, stack);
}

__attribute__((destructor)) static void tell(void) {
  s_in_main = 0;
  if (s_counts[0] == '\0') return;
  char line[64];
  const int length = snprintf(line, sizeof line, "%ld %ld\n", atomic_load(&s_calls), atomic_load(&s_allocations));
  const int file = (int)syscall(SYS_openat, AT_FDCWD, s_counts, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file < 0) return;
  syscall(SYS_write, file, line, (size_t)length);
  syscall(SYS_close, file);
}
