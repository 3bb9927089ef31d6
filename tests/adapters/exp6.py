"""exp6 of the library as an adapter in Python with NumPy: exp6.py LIBRARY, where the C function is. For lab wire."""
import ctypes
import json
import sys

import numpy as np


class Adapter(ctypes.Structure):  # liecheck_adapter.h
    _fields_ = [("interface_version", ctypes.c_uint32), ("name", ctypes.c_char_p), ("version", ctypes.c_char_p),
                ("thread_safe", ctypes.c_int), ("find", ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_char_p, ctypes.c_char_p))]


library = ctypes.CDLL(sys.argv[1])
library.liecheck_get_adapter.restype = ctypes.POINTER(Adapter)
array = ctypes.c_void_p
exp6 = ctypes.CFUNCTYPE(None, ctypes.c_size_t, array, array, array)(
    library.liecheck_get_adapter().contents.find(b"exp6", b"double"))
calls, answers = sys.stdin.buffer, sys.stdout.buffer
calls.readline()
answers.write(json.dumps({"protocol": 1, "name": "exp6_numpy", "version": "1", "operations": {"exp6": ["double"]}}).encode() + b"\n")
answers.flush()
for call in iter(calls.readline, b""):
    n = int(call.split()[3])
    inputs, results, status = np.frombuffer(calls.read(n * 48)), np.empty(n * 12), np.zeros(n, np.uint8)
    exp6(n, inputs.ctypes.data, results.ctypes.data, status.ctypes.data)
    answers.write(b"done %d\n" % n + status.tobytes() + results.tobytes())
    answers.flush()
