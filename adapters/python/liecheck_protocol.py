"""The process protocol of docs/adapters.md, for the Python adapters of this folder."""
import json
import sys

import numpy as np


def serve(name, version, functions):
    """Answers calls until the input ends. functions: operation -> (function, arguments, results, program). A function
    takes the numbers of one input, in double, and returns those of its result. One that raises ValueError refuses the
    input. The program, which may be left out, is the same call for a user of the library, with {phi} and so on for the
    numbers."""
    calls, answers = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr  # what the library prints must not come between the answers
    calls.readline()  # "liecheck 1"
    offered = {operation: ["double"] for operation in functions}
    source = {operation: f[3] for operation, f in functions.items() if len(f) > 3}
    description = {"protocol": 1, "name": name, "version": version, "operations": offered, "source": source}
    answers.write(json.dumps(description).encode() + b"\n")
    answers.flush()
    for call in iter(calls.readline, b""):  # "call exp3_matrix double 128"
        _, operation, _, count = call.decode().split()
        function, arguments, size = functions[operation][:3]
        n, reason = int(count), ""
        inputs = np.frombuffer(bytearray(calls.read(n * arguments * 8)), "<f8").reshape(n, arguments)
        results, status = np.full((n, size), np.nan), bytearray(n)
        for i in range(n):
            try:
                results[i] = np.reshape(function(inputs[i]), size)
            except ValueError as error:
                status[i], reason = 1, " " + " ".join(str(error).split())
        answers.write(f"done {n}{reason}\n".encode() + status + results.tobytes())
        answers.flush()
