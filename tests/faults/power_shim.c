/* Preloaded into the program: every call that changes what is below a folder is written to a log, with its bytes, in
 * the order in which the calls were made. replay_power_cut.py makes of the log what a power cut would have left.
 *   POWER_ROOT=FOLDER   whose files are meant (absolute, without links)
 *   POWER_LOG=FILE      not below it; appended to
 * A record is a line of its kind and fields with tabs between, then as many bytes as its last field says:
 *   new FILE PATH 0, write FILE OFFSET COUNT, size FILE LENGTH 0, sync FILE 0, name FROM TO 0, swap A B 0, gone PATH 0,
 *   folder PATH 0, mark TEXT 0
 * FILE is device:inode; paths hold no tab and no newline. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

static pthread_mutex_t s_lock = PTHREAD_MUTEX_INITIALIZER;
static int s_log = -1;
static char s_root[PATH_MAX];
static size_t s_root_length;

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

__attribute__((constructor)) static void begin(void) {
  const char *root = getenv("POWER_ROOT"), *log = getenv("POWER_LOG");
  if (root == NULL || log == NULL || strlen(root) >= sizeof s_root) return;
  strcpy(s_root, root);
  s_root_length = strlen(s_root);
  s_log = (int)syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
}

static void put(const void* bytes, size_t count) {
  for (const char* at = bytes; count > 0;) {
    const long done = syscall(SYS_write, s_log, at, count);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) abort();
    at += done;
    count -= (size_t)done;
  }
}
static void note(const char* format, ...) {
  char line[3 * PATH_MAX];
  va_list list;
  va_start(list, format);
  const int length = vsnprintf(line, sizeof line, format, list);
  va_end(list);
  put(line, (size_t)length);
}

/* The path, absolute, if it is below the root. */
static int is_ours_at(int folder, const char* path, char* whole) {
  if (s_log < 0) return 0;
  if (path[0] == '/') {
    if (strlen(path) >= PATH_MAX) return 0;
    strcpy(whole, path);
  } else {
    char link[64];
    snprintf(link, sizeof link, folder == AT_FDCWD ? "/proc/self/cwd" : "/proc/self/fd/%d", folder);
    ssize_t count = readlink(link, whole, PATH_MAX - 1);
    if (count <= 0 || (size_t)count + strlen(path) + 2 > PATH_MAX) return 0;
    whole[count] = '/';
    strcpy(whole + count + 1, path);
  }
  return strncmp(whole, s_root, s_root_length) == 0 && (whole[s_root_length] == '/' || whole[s_root_length] == '\0');
}
static int is_ours(const char* path, char* whole) { return is_ours_at(AT_FDCWD, path, whole); }
static int is_ours_file(int file, char* path) {
  if (s_log < 0) return 0;
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t count = readlink(link, path, PATH_MAX - 1);
  if (count <= 0) return 0;
  path[count] = '\0';
  return strncmp(path, s_root, s_root_length) == 0;
}
static void id_of(int file, char* id) {
  struct stat status;
  memset(&status, 0, sizeof status);
  fstat(file, &status);
  snprintf(id, 64, "%lx:%lx", (unsigned long)status.st_dev, (unsigned long)status.st_ino);
}

static int open_at(int folder, const char* path, int flags, mode_t mode) {
  static __typeof__(&openat) real;
  if (real == NULL) real = REAL(openat);
  char whole[PATH_MAX], id[64];
  if ((flags & (O_CREAT | O_TRUNC)) == 0 || !is_ours_at(folder, path, whole)) return real(folder, path, flags, mode);
  pthread_mutex_lock(&s_lock);
  const int was = access(whole, F_OK) == 0;
  const int file = real(folder, path, flags, mode), error = errno;
  if (file >= 0) {
    id_of(file, id);
    if (!was) note("new\t%s\t%s\t0\n", id, whole);
    if (was && (flags & O_TRUNC) != 0) note("size\t%s\t0\t0\n", id);
  }
  pthread_mutex_unlock(&s_lock);
  errno = error;
  return file;
}
#define MODE_OF(flags)                          \
  mode_t mode = 0;                              \
  if (((flags) & (O_CREAT | O_TMPFILE)) != 0) { \
    va_list list;                               \
    va_start(list, flags);                      \
    mode = (mode_t)va_arg(list, unsigned);      \
    va_end(list);                               \
  }
int open(const char* path, int flags, ...) {
  MODE_OF(flags)
  return open_at(AT_FDCWD, path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  MODE_OF(flags)
  return open_at(AT_FDCWD, path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
  MODE_OF(flags)
  return open_at(folder, path, flags, mode);
}
static FILE* fopen_it(FILE* (*real)(const char*, const char*), const char* path, const char* mode) {
  char whole[PATH_MAX], id[64];
  if (strpbrk(mode, "wa") == NULL || !is_ours(path, whole)) return real(path, mode);
  pthread_mutex_lock(&s_lock);
  const int was = access(whole, F_OK) == 0;
  FILE* file = real(path, mode);
  const int error = errno;
  if (file != NULL) {
    id_of(fileno(file), id);
    if (!was) note("new\t%s\t%s\t0\n", id, whole);
    if (was && strchr(mode, 'w') != NULL) note("size\t%s\t0\t0\n", id);
  }
  pthread_mutex_unlock(&s_lock);
  errno = error;
  return file;
}
FILE* fopen(const char* path, const char* mode) { return fopen_it(REAL(fopen), path, mode); }
FILE* fopen64(const char* path, const char* mode) { return fopen_it(REAL(fopen64), path, mode); }

static void wrote(int file, const void* bytes, ssize_t count, off_t end) {
  char id[64];
  id_of(file, id);
  note("write\t%s\t%ld\t%zd\n", id, (long)(end - count), count);
  put(bytes, (size_t)count);
}
ssize_t write(int file, const void* bytes, size_t count) {
  static __typeof__(&write) real;
  if (real == NULL) real = REAL(write);
  char path[PATH_MAX];
  if (!is_ours_file(file, path)) return real(file, bytes, count);
  pthread_mutex_lock(&s_lock);
  const ssize_t done = real(file, bytes, count);
  const int error = errno;
  if (done > 0) wrote(file, bytes, done, lseek(file, 0, SEEK_CUR));
  pthread_mutex_unlock(&s_lock);
  errno = error;
  return done;
}
ssize_t writev(int file, const struct iovec* pieces, int count) {
  char path[PATH_MAX];
  if (!is_ours_file(file, path)) return REAL(writev)(file, pieces, count);
  ssize_t total = 0;
  for (int i = 0; i < count; ++i) {
    const ssize_t done = write(file, pieces[i].iov_base, pieces[i].iov_len);
    if (done < 0) return total > 0 ? total : -1;
    total += done;
    if ((size_t)done < pieces[i].iov_len) break;
  }
  return total;
}
ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  char path[PATH_MAX];
  if (!is_ours_file(file, path)) return REAL(pwrite)(file, bytes, count, at);
  pthread_mutex_lock(&s_lock);
  const ssize_t done = REAL(pwrite)(file, bytes, count, at);
  const int error = errno;
  if (done > 0) wrote(file, bytes, done, at + done);
  pthread_mutex_unlock(&s_lock);
  errno = error;
  return done;
}
/* Copies inside the kernel go by write() instead. */
ssize_t sendfile(int out, int in, off_t* offset, size_t count) {
  char path[PATH_MAX], piece[65536];
  if (!is_ours_file(out, path)) return REAL(sendfile)(out, in, offset, count);
  const size_t most = count < sizeof piece ? count : sizeof piece;
  const ssize_t got = offset != NULL ? pread(in, piece, most, *offset) : read(in, piece, most);
  if (got <= 0) return got;
  const ssize_t done = write(out, piece, (size_t)got);
  if (done > 0 && offset != NULL) *offset += done;
  return done;
}
ssize_t copy_file_range(int in, off_t* in_at, int out, off_t* out_at, size_t count, unsigned flags) {
  char path[PATH_MAX];
  if (!is_ours_file(out, path)) return REAL(copy_file_range)(in, in_at, out, out_at, count, flags);
  errno = ENOSYS;
  return -1;
}
int ftruncate(int file, off_t length) {
  char path[PATH_MAX], id[64];
  if (!is_ours_file(file, path)) return REAL(ftruncate)(file, length);
  pthread_mutex_lock(&s_lock);
  const int result = REAL(ftruncate)(file, length), error = errno;
  id_of(file, id);
  if (result == 0) note("size\t%s\t%ld\t0\n", id, (long)length);
  pthread_mutex_unlock(&s_lock);
  errno = error;
  return result;
}

static int sync_it(int (*real)(int), int file) {
  char path[PATH_MAX], id[64];
  if (!is_ours_file(file, path)) return real(file);
  pthread_mutex_lock(&s_lock);
  const int result = real(file), error = errno;
  id_of(file, id);
  if (result == 0) note("sync\t%s\t%s\t0\n", id, path);
  pthread_mutex_unlock(&s_lock);
  errno = error;
  return result;
}
int fsync(int file) { return sync_it(REAL(fsync), file); }
int fdatasync(int file) { return sync_it(REAL(fdatasync), file); }

/* A call on one or two names, which is noted if it was done. */
#define NAMED(call, ...)                    \
  pthread_mutex_lock(&s_lock);              \
  const int result = (call), error = errno; \
  if (result == 0) note(__VA_ARGS__);       \
  pthread_mutex_unlock(&s_lock);            \
  errno = error;                            \
  return result;

int rename(const char* from, const char* to) {
  char a[PATH_MAX], b[PATH_MAX];
  if (!is_ours(from, a) || !is_ours(to, b)) return REAL(rename)(from, to);
  NAMED(REAL(rename)(from, to), "name\t%s\t%s\t0\n", a, b)
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  char a[PATH_MAX], b[PATH_MAX];
  if (!is_ours_at(from_folder, from, a) || !is_ours_at(to_folder, to, b))
    return REAL(renameat2)(from_folder, from, to_folder, to, flags);
  NAMED(REAL(renameat2)(from_folder, from, to_folder, to, flags), "%s\t%s\t%s\t0\n",
        (flags & RENAME_EXCHANGE) != 0 ? "swap" : "name", a, b)
}
int mkdir(const char* path, mode_t mode) {
  char whole[PATH_MAX];
  if (!is_ours(path, whole)) return REAL(mkdir)(path, mode);
  NAMED(REAL(mkdir)(path, mode), "folder\t%s\t0\n", whole)
}
int unlink(const char* path) {
  char whole[PATH_MAX];
  if (!is_ours(path, whole)) return REAL(unlink)(path);
  NAMED(REAL(unlink)(path), "gone\t%s\t0\n", whole)
}
int rmdir(const char* path) {
  char whole[PATH_MAX];
  if (!is_ours(path, whole)) return REAL(rmdir)(path);
  NAMED(REAL(rmdir)(path), "gone\t%s\t0\n", whole)
}
int remove(const char* path) {
  char whole[PATH_MAX];
  if (!is_ours(path, whole)) return REAL(remove)(path);
  NAMED(REAL(remove)(path), "gone\t%s\t0\n", whole)
}
int unlinkat(int folder, const char* path, int flags) {
  char whole[PATH_MAX];
  if (!is_ours_at(folder, path, whole)) return REAL(unlinkat)(folder, path, flags);
  NAMED(REAL(unlinkat)(folder, path, flags), "gone\t%s\t0\n", whole)
}
