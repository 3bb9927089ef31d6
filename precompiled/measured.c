// measured LOG COMMAND...: runs a compiler, and appends a line to LOG: the CPU seconds of the command with all its
// children, the largest memory of one of them [kB], the object file, and "ccache" if ccache had it, else "compiled".
// CMake compiles this file when it configures, and starts every compiler of C++ through it.
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/// Whether the file, in which ccache writes what it did, has a word for a hit. Removes the file.
static int was_in_ccache(const char* log) {
  char line[4096];
  int hit = 0;
  FILE* const file = fopen(log, "r");
  if (!file) return 0;
  while (fgets(line, sizeof line, file))
    if (line[0] != '#' && strstr(line, "_cache_hit")) hit = 1;
  fclose(file);
  unlink(log);
  return hit;
}

static double seconds(struct timeval t) {
  return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

int main(int count, char** arguments) {
  if (count < 3) return fputs("usage: measured LOG COMMAND...\n", stderr), 2;
  const char* object = NULL;
  for (int i = 3; i + 1 < count; ++i)
    if (strcmp(arguments[i], "-o") == 0) object = arguments[i + 1];
  char of_ccache[4096] = "";
  if (object) {
    snprintf(of_ccache, sizeof of_ccache, "%s.ccache", object);
    setenv("CCACHE_STATSLOG", of_ccache, 1);
  }
  const pid_t child = fork();
  if (child == 0) {
    execvp(arguments[2], arguments + 2);
    perror(arguments[2]);
    _exit(127);
  }
  int status = 0;
  struct rusage used;
  if (child < 0 || wait4(child, &status, 0, &used) < 0) return perror("measured"), 1;
  const int hit = object && was_in_ccache(of_ccache);
  if (WIFSIGNALED(status)) {
    signal(WTERMSIG(status), SIG_DFL);
    raise(WTERMSIG(status));
  }
  if (object && WEXITSTATUS(status) == 0) {
    char line[8192];
    const int length =
        snprintf(line, sizeof line, "%.2f %ld %s %s\n", seconds(used.ru_utime) + seconds(used.ru_stime),
                 used.ru_maxrss, hit ? "ccache" : "compiled", object);
    const int log = open(arguments[1], O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    // One call, so that the lines of compilers that run at the same time do not mix.
    if (log < 0 || write(log, line, (size_t)length) != length) perror(arguments[1]);
    if (log >= 0) close(log);
  }
  return WEXITSTATUS(status);
}
