"""An adapter whose program behaves badly in one of many ways, which LIECHECK_BAD names: the same as bad_citizens.cpp,
as far as a process can. Each input with |phi_x| between 0.5 and 1 makes it do so."""
import ctypes
import math
import os
import struct
import sys
import time

WAY = os.environ.get("LIECHECK_BAD", "")
calls_made = 0
last_x = previous_x = 0.0


def misbehave(phi, Q):
    """What happens before the result of an input is given."""
    if WAY == "segfault":
        ctypes.string_at(0)
    if WAY == "abort":
        os.abort()
    while WAY == "loop":
        pass
    if WAY == "exit":
        sys.exit(0)
    if WAY == "memory":
        bytearray(10 << 30)
    if WAY == "throw":
        raise RuntimeError("not a rotation")
    if WAY == "slow":
        time.sleep(0.1)
    if WAY == "print":
        os.write(1, b"phi\n")
    if WAY == "rounding":
        ctypes.CDLL("libm.so.6").fesetround(0x800)
    if WAY == "flush":
        ctypes.CDLL("libm.so.6").fesetenv(ctypes.byref(flushing))
    if WAY == "input":
        phi[1] = math.nan
    if WAY == "order" and previous_x > phi[0]:
        Q[0] = math.nextafter(Q[0], 2)
    if WAY == "nan":
        Q[3] = math.nan


flushing = (ctypes.c_uint32 * 8)(0xffff037f, 0xffff0000, 0xffffffff, 0, 0, 0, 0, 0x9fc0)  # fenv_t of x86-64 Linux


def exp3_quaternion(phi):
    global calls_made, last_x, previous_x
    phi = list(phi)
    if phi[0] != last_x:
        previous_x, last_x = last_x, phi[0]
    theta = math.hypot(*phi)
    s = math.sin(theta / 2) / theta if theta > 1e-8 else 0.5
    Q = [s * x for x in phi] + [math.cos(theta / 2)]
    calls_made += 1
    if WAY == "stateful" and calls_made % 1000 == 0:
        Q[0] += 1e-3
    if is_bad(phi):
        misbehave(phi, Q)
    return Q


def is_bad(phi):
    return 0.5 <= abs(phi[0]) <= 1


sys.stdin.buffer.readline()
os.write(1, b'{"protocol": 1, "name": "bad", "version": "1", "operations": {"exp3_quaternion": ["double"]}}\n')
for call in iter(sys.stdin.buffer.readline, b""):
    n = int(call.split()[3])
    inputs = list(struct.iter_unpack("<3d", sys.stdin.buffer.read(24 * n)))
    results = [exp3_quaternion(phi) for phi in inputs]
    answer = bytearray(n) + b"".join(struct.pack("<4d", *Q) for Q in results)
    if any(is_bad(phi) for phi in inputs):
        if WAY == "half":
            answer = answer[:len(answer) // 2]
        if WAY == "count":
            answer += bytes(32)
        if WAY == "status":
            answer[0] = 77
    os.write(1, b"done %d\n" % n + answer)
