/* Preloaded into a program: a clock that is set back by an hour at each look (LIECHECK_CLOCK=back), and a quota of so many
 * bytes for files (LIECHECK_QUOTA). */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

static time_t earlier(time_t now) {
  static time_t past;
  const char* const how = getenv("LIECHECK_CLOCK");
  return how && how[0] == 'b' ? now - (past += 3600) : now;
}

int clock_gettime(clockid_t clock, struct timespec* to) {
  int (*const real)(clockid_t, struct timespec*) =
      (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
  const int code = real(clock, to);
  if (clock == CLOCK_REALTIME) to->tv_sec = earlier(to->tv_sec);
  return code;
}
int gettimeofday(struct timeval* restrict to, void* restrict zone) {
  int (*const real)(struct timeval*, void*) =
      (int (*)(struct timeval*, void*))dlsym(RTLD_NEXT, "gettimeofday");
  const int code = real(to, zone);
  to->tv_sec = earlier(to->tv_sec);
  return code;
}
time_t time(time_t* to) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (to) *to = now.tv_sec;
  return now.tv_sec;
}

/* How many of n bytes may be written to the file. */
static size_t allowed(int file, size_t n) {
  static size_t written;
  const char* const quota = getenv("LIECHECK_QUOTA");
  struct stat what;
  if (!quota || fstat(file, &what) != 0 || !S_ISREG(what.st_mode) || file <= 2) return n;
  const size_t most = strtoul(quota, 0, 10), left = most > written ? most - written : 0;
  if (n > left) n = left;
  written += n;
  return n;
}

ssize_t write(int file, const void* bytes, size_t n) {
  ssize_t (*const real)(int, const void*, size_t) = (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
  const size_t some = allowed(file, n);
  if (n > 0 && some == 0) return errno = EDQUOT, -1;
  return real(file, bytes, some);
}
ssize_t pwrite64(int file, const void* bytes, size_t n, off64_t at) {
  ssize_t (*const real)(int, const void*, size_t, off64_t) =
      (ssize_t(*)(int, const void*, size_t, off64_t))dlsym(RTLD_NEXT, "pwrite64");
  const size_t some = allowed(file, n);
  if (n > 0 && some == 0) return errno = EDQUOT, -1;
  return real(file, bytes, some, at);
}
ssize_t writev(int file, const struct iovec* parts, int n) {
  ssize_t all = 0;
  for (int i = 0; i < n; ++i) {
    const ssize_t some = write(file, parts[i].iov_base, parts[i].iov_len);
    if (some < 0) return all > 0 ? all : some;
    all += some;
    if ((size_t)some < parts[i].iov_len) break;
  }
  return all;
}
