/* The C interface of an adapter, version 2 (C99). A shared library that exports liecheck_get_adapter() offers
 * its functions to liecheck:
 *
 *     liecheck campaign --adapter ./libmylib_adapter.so
 *
 * docs/conventions.md has the arguments and results of each operation, docs/start.md an example. */
#ifndef LIECHECK_ADAPTER_H
#define LIECHECK_ADAPTER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Adapters of version 1, whose struct ends with `conventions`, are still taken. */
#define LIECHECK_ADAPTER_VERSION 2

/* The status of one input. liecheck sets each status to liecheck_done before the call. */
enum liecheck_status {
  liecheck_done = 0,
  liecheck_refused = 1 /* the library does not accept this input; the result is not read */
};

/* Computes n results. `inputs` holds n times the arguments of the operation, and `results` has room for n times
 * its result: consecutive numbers (float or double) without padding. A function must not write to `inputs`.
 * It may be called from several threads at the same time only if the adapter says thread_safe. */
typedef void (*liecheck_function)(size_t n, const void* inputs, void* results, unsigned char* status);

/* The same, with what it belongs to: the context of the adapter, or a handle of open_model. */
typedef void (*liecheck_call)(void* context, size_t n, const void* inputs, void* results,
                              unsigned char* status);

/* A tree of bodies or a robot. docs/adapters.md defines each member. */
struct liecheck_joint {
  const char* kind;          /* "revolute", "continuous", ... */
  int parent;                /* an earlier joint, or -1 for the world */
  double Q[4], p[3];         /* the pose in the parent's frame where q is neutral */
  double axis[3];            /* of a kind that has one */
  double pitch;              /* of a helical joint [m/rad] */
  double armature;           /* of each velocity [kg, kg m^2] */
  int mimic;                 /* the joint that it mimics, or -1 */
  double multiplier, offset; /* of a mimic */
};
struct liecheck_body {
  int joint;                 /* that carries it */
  double Q[4], p[3];         /* its pose in the joint's frame */
  double mass, c[3], I_C[9]; /* in its own frame */
};
struct liecheck_model {
  double gravity[3]; /* in world axes [m/s^2] */
  size_t nq, nv;
  size_t joint_count, body_count;
  const struct liecheck_joint* joints;
  const struct liecheck_body* bodies;
  const char* urdf; /* instead of joints and bodies: the text of a URDF; otherwise NULL */
  int fixed;        /* of a URDF: 1 if its root is fixed to the world, 0 if a free-flyer carries it */
  size_t order_count;
  const char* const* order; /* of a URDF: the names of the joints that move, in the order of q and v */
};

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
   * first". "pose form: quaternion" says that poses are (p, Q), of 7 numbers. docs/conventions.md has all. May be NULL. */
  const char* conventions;

  /* Version 2 from here on. What is NULL is not offered. */
  void* context; /* is given to each function below */

  /* In place of `find`, which may be NULL then. It is also asked for the library's own checks, "check_quaternion" (4
   * numbers) and "check_rotation" (9), which have no result and refuse what the library's operations do not accept. */
  liecheck_call (*find_call)(void* context, const char* operation, const char* scalar);

  /* Trees and robots: docs/adapters.md. */
  const char* models; /* "joints", "urdf" or both; with "mimics", it couples those of a URDF */
  const char* joints; /* "revolute, prismatic": the kinds of joints that it takes; NULL for all */
  /* A handle for the model, or NULL if it is refused; reason() says why. `model` is valid during the call only. */
  void* (*open_model)(void* context, const struct liecheck_model* model);
  void (*close_model)(void* context, void* handle);
  /* The function of an operation on trees or robots. Its context is the handle of the model. */
  liecheck_call (*find_model_call)(void* context, const char* operation, const char* scalar);
};

/* The library defines this function. */
const struct liecheck_adapter* liecheck_get_adapter(void);

/* The library may define this function, too. It returns a program in the library's own terms that calls the operation,
 * with {phi} where the numbers of the argument phi belong, or NULL. A failure is printed with it. */
const char* liecheck_get_source(const char* operation);

/* And this one: the references in which it sees frames, "world, local, aligned" or fewer. NULL for all. */
const char* liecheck_get_references(void);

/* Loops over calls of one operation, which `liecheck cost` times. */
struct liecheck_loops {
  int own_types; /* 1 if the loops call with arguments and results in the library's own types, 0 if with numbers */
  /* Makes the arguments of n calls, whose numbers `inputs` holds; NULL if it cannot. `context` is the adapter's. */
  void* (*prepare)(void* context, size_t n, const void* inputs);
  void (*release)(void* calls);
  /* Makes the calls from `first` to `first` + n - 1, which do not wait for one another. */
  void (*throughput)(const void* calls, size_t first, size_t n);
  /* The same; each waits for the result of the one before. */
  void (*latency)(const void* calls, size_t first, size_t n);
};

/* And this one: the loops of an operation in a scalar, or NULL. The header for C++ defines it. Without it, the functions
 * of the adapter are timed. */
const struct liecheck_loops* liecheck_get_loops(const char* operation, const char* scalar);

#ifdef __cplusplus
}
#endif

#endif
