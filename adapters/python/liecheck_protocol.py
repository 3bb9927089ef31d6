"""The process protocol of docs/adapters.md, for the Python adapters of this folder."""
import json
import sys
import time

import numpy as np


def timed(calls, passes):
    """The processor time [ns] of passes over all calls."""
    start = time.thread_time_ns()
    for _ in range(passes):
        for function, arguments in calls:
            function(*arguments)
    return time.thread_time_ns() - start


def serve(name, version, functions, many=(), own={}):
    """Answers calls until the input ends. functions: operation -> (function, arguments, results, program). A function
    takes the numbers of one input, in double, and returns those of its result. One that raises ValueError refuses the
    input. The program, which may be left out, is the same call for a user of the library, with {phi} and so on for the
    numbers. many: the operations whose functions take an array of inputs, too, one in each row. own: operation -> a
    function that makes of an input the library's own function and its arguments, in the library's own types, which is
    timed instead."""
    calls, answers = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr  # what the library prints must not come between the answers
    calls.readline()  # "liecheck 1"
    offered = {operation: ["double"] for operation in functions}
    source = {operation: f[3] for operation, f in functions.items() if len(f) > 3}
    times = {o: "one" + ", many" * (o in many) + ", own types" * (o in own) for o in functions}
    description = {"protocol": 1, "name": name, "version": version, "operations": offered, "source": source, "timed": times}
    answers.write(json.dumps(description).encode() + b"\n")
    answers.flush()
    for call in iter(calls.readline, b""):  # "call exp3_matrix double 128", or "time one exp3_matrix double 256 10"
        words = call.decode().split()
        how, passes = (words.pop(1), int(words.pop())) if words[0] == "time" else ("", 0)
        _, operation, _, count = words
        function, arguments, size = functions[operation][:3]
        n, reason = int(count), ""
        inputs = np.frombuffer(bytearray(calls.read(n * arguments * 8)), "<f8").reshape(n, arguments)
        if passes:
            call_of = own.get(operation, lambda x: (function, (x,))) if how != "nothing" else lambda x: (lambda x: x, (x,))
            calls_of_library = [call_of(x) for x in ([inputs] if how == "many" else inputs)]
            answers.write(f"timed {timed(calls_of_library, passes)}\n".encode())
            answers.flush()
            continue
        results, status = np.full((n, size), np.nan), bytearray(n)
        for i in range(n):
            try:
                results[i] = np.reshape(function(inputs[i]), size)
            except ValueError as error:
                status[i], reason = 1, " " + " ".join(str(error).split())
        answers.write(f"done {n}{reason}\n".encode() + status + results.tobytes())
        answers.flush()
