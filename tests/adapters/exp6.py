"""exp6 of the library as an adapter in Python with NumPy: exp6.py LIBRARY, where the C function is. For lab wire."""
import ctypes
import json
import sys

import numpy as np


text, array = ctypes.c_char_p, ctypes.c_void_p


class Adapter(ctypes.Structure):  # liecheck_adapter.h
    _fields_ = [("interface_version", ctypes.c_uint32), ("name", text), ("version", text), ("thread_safe", ctypes.c_int),
                ("find", array), ("reason", array), ("conventions", text), ("context", array),
                ("find_call", ctypes.CFUNCTYPE(array, array, text, text))]


library = ctypes.CDLL(sys.argv[1])
library.liecheck_get_adapter.restype = ctypes.POINTER(Adapter)
adapter = library.liecheck_get_adapter().contents
exp6 = ctypes.CFUNCTYPE(None, array, ctypes.c_size_t, array, array, array)(
    adapter.find_call(adapter.context, b"exp6", b"double"))
calls, answers = sys.stdin.buffer, sys.stdout.buffer
calls.readline()
answers.write(json.dumps({"protocol": 1, "name": "exp6_numpy", "version": "1", "operations": {"exp6": ["double"]}}).encode() + b"\n")
answers.flush()
for call in iter(calls.readline, b""):
    n = int(call.split()[3])
    inputs, results, status = np.frombuffer(calls.read(n * 48)), np.empty(n * 12), np.zeros(n, np.uint8)
    exp6(adapter.context, n, inputs.ctypes.data, results.ctypes.data, status.ctypes.data)
    answers.write(b"done %d\n" % n + status.tobytes() + results.tobytes())
    answers.flush()
