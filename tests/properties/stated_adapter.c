/* An adapter in C that states a convention wrongly: its quaternions are x y z w. */
#include <liecheck_adapter.h>
#include <math.h>
#include <string.h>

static void exp3_quaternion(size_t n, const void* inputs, void* results, unsigned char* status) {
  const double* phi = inputs;
  double* q = results;
  (void)status;
  for (; n > 0; --n, phi += 3, q += 4) {
    const double theta = hypot(hypot(phi[0], phi[1]), phi[2]), s = theta > 0 ? sin(theta / 2) / theta : 0.5;
    for (int i = 0; i < 3; ++i) q[i] = s * phi[i];
    q[3] = cos(theta / 2);
  }
}

static liecheck_function find(const char* operation, const char* scalar) {
  return strcmp(operation, "exp3_quaternion") == 0 && strcmp(scalar, "double") == 0 ? exp3_quaternion : NULL;
}

static const struct liecheck_adapter adapter = {.interface_version = LIECHECK_ADAPTER_VERSION,
                                                .name = "stated",
                                                .version = "1",
                                                .find = find,
                                                .conventions = "quaternion: wxyz, twist: angular first"};

const struct liecheck_adapter* liecheck_get_adapter(void) { return &adapter; }
