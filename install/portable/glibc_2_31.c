/* Lets a program that is linked on Debian 12 run with the glibc of Debian 11 (2.31). glibc moved functions of libpthread
 * and libdl to libc.so.6 in 2.34, and gave them new versions; it still has the old ones. The linker's option
 * --wrap=FUNCTION makes each call of FUNCTION one of __wrap_FUNCTION, which is here. CMakeLists.txt reads these names. */
#define _GNU_SOURCE
#include <elf.h>
#include <link.h>
#include <stddef.h>
#include <sys/random.h>
#include <sys/stat.h>

/* The function of an older version, with the same arguments and result. */
#define OLDER(function, version)                                           \
  __asm__(".symver older_" #function ", " #function "@GLIBC_" version "\n" \
          ".pushsection .text\n"                                           \
          ".globl __wrap_" #function "\n"                                  \
          ".type __wrap_" #function ", @function\n"                        \
          "__wrap_" #function ": jmp older_" #function "@PLT\n"            \
          ".popsection")

OLDER(__pthread_key_create, "2.2.5");
OLDER(dladdr, "2.2.5");
OLDER(dlclose, "2.2.5");
OLDER(dlerror, "2.2.5");
OLDER(dlopen, "2.2.5");
OLDER(dlsym, "2.2.5");
OLDER(hypot, "2.2.5");
OLDER(hypotf, "2.2.5");
OLDER(pthread_attr_getstacksize, "2.2.5");
OLDER(pthread_attr_setaffinity_np, "2.3.4");
OLDER(pthread_attr_setstacksize, "2.2.5");
OLDER(pthread_cond_clockwait, "2.30");
OLDER(pthread_create, "2.2.5");
OLDER(pthread_detach, "2.2.5");
OLDER(pthread_getaffinity_np, "2.3.4");
OLDER(pthread_getspecific, "2.2.5");
OLDER(pthread_join, "2.2.5");
OLDER(pthread_key_create, "2.2.5");
OLDER(pthread_key_delete, "2.2.5");
OLDER(pthread_mutex_trylock, "2.2.5");
OLDER(pthread_mutexattr_destroy, "2.2.5");
OLDER(pthread_mutexattr_init, "2.2.5");
OLDER(pthread_mutexattr_settype, "2.2.5");
OLDER(pthread_once, "2.2.5");
OLDER(pthread_rwlock_destroy, "2.2.5");
OLDER(pthread_rwlock_init, "2.2.5");
OLDER(pthread_rwlock_rdlock, "2.2.5");
OLDER(pthread_rwlock_unlock, "2.2.5");
OLDER(pthread_rwlock_wrlock, "2.2.5");
OLDER(pthread_setaffinity_np, "2.3.4");
OLDER(pthread_setspecific, "2.2.5");
OLDER(pthread_sigmask, "2.2.5");

/* Before 2.33, stat was an inline function of the headers that called __xstat with the version of the struct, 1. */
int __xstat(int, const char*, struct stat*);
int __lxstat(int, const char*, struct stat*);
int __fxstat(int, int, struct stat*);
int __wrap_stat(const char* path, struct stat* status) { return __xstat(1, path, status); }
int __wrap_stat64(const char* path, struct stat* status) { return __xstat(1, path, status); }
int __wrap_lstat(const char* path, struct stat* status) { return __lxstat(1, path, status); }
int __wrap_lstat64(const char* path, struct stat* status) { return __lxstat(1, path, status); }
int __wrap_fstat(int file, struct stat* status) { return __fxstat(1, file, status); }
int __wrap_fstat64(int file, struct stat* status) { return __fxstat(1, file, status); }

/* false is always right: reference counts are then always atomic. */
char __wrap___libc_single_threaded = 0;

void __wrap_arc4random_buf(void* to, size_t size) {
  for (char* next = to; size > 0;) {
    const ssize_t n = getrandom(next, size, 0); /* -1 if a signal interrupts it */
    if (n > 0) next += n, size -= (size_t)n;
  }
}
unsigned __wrap_arc4random(void) {
  unsigned number;
  __wrap_arc4random_buf(&number, sizeof number);
  return number;
}

const char* __wrap_sigabbrev_np(int number) {
  static const char names[][8] = {
      "",     "HUP",  "INT",    "QUIT", "ILL",  "TRAP", "ABRT", "BUS",  "FPE", "KILL", "USR1",
      "SEGV", "USR2", "PIPE",   "ALRM", "TERM", "STKFLT", "CHLD", "CONT", "STOP", "TSTP", "TTIN",
      "TTOU", "URG",  "XCPU",   "XFSZ", "VTALRM", "PROF", "WINCH", "POLL", "PWR", "SYS"};
  return number > 0 && number < 32 ? names[number] : NULL;
}

/* The unwinder of gcc 12 asks which object has the code at an address, and for the table of its frames. */
struct search {
  ElfW(Addr) address;
  struct dl_find_object* result;
};
static int in_object(struct dl_phdr_info* object, size_t size, void* data) {
  const struct search* const s = data;
  (void)size;
  const ElfW(Phdr)* frames = NULL;
  const ElfW(Phdr)* code = NULL;
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)* const part = &object->dlpi_phdr[i];
    if (part->p_type == PT_GNU_EH_FRAME) frames = part;
    if (part->p_type == PT_LOAD && s->address - object->dlpi_addr - part->p_vaddr < part->p_memsz) code = part;
  }
  if (!code || !frames) return 0;
  s->result->dlfo_eh_frame = (void*)(object->dlpi_addr + frames->p_vaddr);
  return 1;
}
int __wrap__dl_find_object(void* address, struct dl_find_object* result) {
  struct search s = {(ElfW(Addr))address, result};
  return dl_iterate_phdr(in_object, &s) ? 0 : -1;
}

/* Since 2.34, __libc_start_main itself runs the constructors of the program; before, it ran a function that it was given. */
extern void (*__init_array_start[])(int, char**, char**) __attribute__((visibility("hidden")));
extern void (*__init_array_end[])(int, char**, char**) __attribute__((visibility("hidden")));
static void construct(int argc, char** argv, char** environment) {
  const size_t count = __init_array_end - __init_array_start;
  for (size_t i = 0; i < count; ++i) __init_array_start[i](argc, argv, environment);
}
__asm__(".symver older_start_main, __libc_start_main@GLIBC_2.2.5");
int older_start_main(int (*)(int, char**, char**), int, char**, void (*)(int, char**, char**), void (*)(void),
                     void (*)(void), void*);
int __wrap___libc_start_main(int (*main)(int, char**, char**), int argc, char** argv,
                             void (*init)(int, char**, char**), void (*fini)(void), void (*loader_fini)(void),
                             void* stack_end) {
  (void)init;
  return older_start_main(main, argc, argv, construct, fini, loader_fini, stack_end);
}
