import json
import sys

import numpy as np

import mylib


def inverse(X):
    R, p = mylib.inverse(X[:9].reshape(3, 3), X[9:])
    return np.concatenate([R.ravel(), p])


FUNCTIONS = {  # operation: function, how many numbers it takes and gives
    "exp3_quaternion": (mylib.exp, 3, 4),
    "exp3_matrix": (mylib.matrix, 3, 9),
    "log3_quaternion": (mylib.log, 4, 3),
    "left_jacobian6": (lambda xi: mylib.left_jacobian(xi[:3], xi[3:]), 6, 36),
    "inverse": (inverse, 12, 12)}
calls, answers = sys.stdin.buffer, sys.stdout.buffer
sys.stdout = sys.stderr  # what the library prints must not come between the answers
calls.readline()
answers.write(json.dumps({"protocol": 1, "name": "mylib_python", "version": "1.0", "conventions": {"quaternion": "wxyz"},
                          "operations": {name: ["double"] for name in FUNCTIONS}}).encode() + b"\n")
answers.flush()
for call in iter(calls.readline, b""):  # "call exp3_matrix double 128"
    _, name, _, count = call.decode().split()
    function, size, result_size = FUNCTIONS[name]
    inputs = np.frombuffer(calls.read(int(count) * size * 8)).reshape(-1, size)
    status, results = bytearray(int(count)), np.zeros((int(count), result_size))
    for i, x in enumerate(inputs):
        try:
            results[i] = np.ravel(function(x))
        except ArithmeticError:  # the library refuses this input
            status[i] = 1
    answers.write(f"done {count}\n".encode() + status + results.tobytes())
    answers.flush()
