/* The C interface of an adapter, version 1 (C99). A shared library that exports liecheck_get_adapter() offers
 * its functions to liecheck:
 *
 *     liecheck campaign --adapter ./libmylib_adapter.so
 *
 * docs/adapters.md has the arguments and results of each operation, and an example. */
#ifndef LIECHECK_ADAPTER_H
#define LIECHECK_ADAPTER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LIECHECK_ADAPTER_VERSION 1

/* The status of one input. liecheck sets each status to liecheck_done before the call. */
enum liecheck_status {
  liecheck_done = 0,
  liecheck_refused = 1 /* the library does not accept this input; the result is not read */
};

/* Computes n results. `inputs` holds n times the arguments of the operation, and `results` has room for n times
 * its result: consecutive numbers (float or double) without padding. A function must not write to `inputs`.
 * It may be called from several threads at the same time only if the adapter says thread_safe. */
typedef void (*liecheck_function)(size_t n, const void* inputs, void* results, unsigned char* status);

struct liecheck_adapter {
  uint32_t interface_version; /* LIECHECK_ADAPTER_VERSION */
  const char* name;           /* of the subject: letters, digits, '_', '-' */
  const char* version;        /* of the library under test */
  int thread_safe;

  /* The function of an operation ("exp6") in a scalar ("float" or "double"); NULL if it is not offered. */
  liecheck_function (*find)(const char* operation, const char* scalar);

  /* Why the last call refused an input, in words. May be NULL. */
  const char* (*reason)(void);

  /* Conventions in which the library differs from liecheck, which converts them: "quaternion: wxyz, twist: angular
   * first". docs/adapters.md has all. May be NULL. */
  const char* conventions;
};

/* The library defines this function. */
const struct liecheck_adapter* liecheck_get_adapter(void);

/* The library may define this function, too. It returns a program in the library's own terms that calls the operation,
 * with {phi} where the numbers of the argument phi belong, or NULL. A failure is printed with it. */
const char* liecheck_get_source(const char* operation);

#ifdef __cplusplus
}
#endif

#endif
