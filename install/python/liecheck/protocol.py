"""The process protocol of docs/adapters.md: answers calls on standard input until it ends."""
import json
import os
import sys
import time
from typing import Any, Callable, NamedTuple, Optional

import numpy as np

REFUSALS = ArithmeticError, ValueError, NotImplementedError, AssertionError, np.linalg.LinAlgError
TYPES = {"float": np.dtype("<f4"), "double": np.dtype("<f8")}


class Function(NamedTuple):
    """An operation on flat arrays: one takes the numbers of an input to those of its result, many takes many inputs, one in
    each row. prepared makes of an input, or of many, a function and its arguments, in the library's own types, which is
    timed. One of REFUSALS refuses the input; any other exception ends the process."""
    arguments: int
    results: int
    one: Callable
    many: Optional[Callable] = None
    prepared: Optional[Callable] = None


def reason(error):
    """Why an input is refused."""
    return " ".join(str(error).split()) or type(error).__name__


def rounded(result, to):
    with np.errstate(all="ignore"):  # a result beyond the range of a float is infinite
        to[...] = result


def call(function, inputs):
    """The results of a row of inputs each, the status of each, and why the last one is refused."""
    n, why = len(inputs), ""
    results, status = np.full((n, function.results), np.nan, inputs.dtype), bytearray(n)
    if function.many:
        try:
            rounded(function.many(inputs.copy()), results)
            return results, status, ""
        except REFUSALS:  # one of them is refused: each is called alone
            pass
    for i in range(n):
        try:
            rounded(function.many(inputs[i:i + 1])[0] if function.many else function.one(inputs[i]), results[i])
        except REFUSALS as error:
            status[i], why = 1, " " + reason(error)
    return results, status, why


def timed(function, how, inputs, passes):
    """The processor time [ns] of passes over all inputs: of one call each, of one call of all, or of a function that
    returns its argument."""
    prepared = function.prepared or (lambda x: (function.one, (x,)))
    if how == "nothing":
        prepared = lambda x: (lambda y: y, (x,))
    calls = [prepared(x) for x in ([inputs] if how == "many" else inputs)]
    start = time.thread_time_ns()
    for _ in range(passes):
        for f, arguments in calls:
            f(*arguments)
    return time.thread_time_ns() - start


def answer(description: dict, functions: dict, open_model: Optional[Callable[[Any], dict]] = None):
    """functions: operation -> Function; open_model: those of the operations on a model, which one of REFUSALS or a KeyError refuses."""
    calls, answers = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what the library prints must not come between the answers
    sys.stdout = sys.stderr
    calls.readline()  # "liecheck 1"

    def say(line, *data):
        answers.write(b"".join([line.encode(), b"\n", *data]))
        answers.flush()

    say(json.dumps({"protocol": 1, **description}))
    of_model = {}
    for line in iter(calls.readline, b""):
        if line.startswith(b"model "):
            try:
                of_model = open_model(json.loads(line[6:]))
                say("done")
            except (*REFUSALS, KeyError) as error:
                say("refused " + reason(error))
            continue
        words = line.decode().split()  # "call exp3_matrix double 128", or "time one exp3_matrix double 256 10"
        how, passes = (words.pop(1), int(words.pop())) if words[0] == "time" else ("", 0)
        _, operation, scalar, n = words
        function, kind = functions.get(operation) or of_model[operation], TYPES[scalar]
        data = bytearray(calls.read(int(n) * function.arguments * kind.itemsize))
        inputs = np.frombuffer(data, kind).reshape(int(n), function.arguments)
        if how:
            say(f"timed {timed(function, how, inputs, passes)}")
        else:
            results, status, why = call(function, inputs)
            say(f"done {n}{why}", status, results.tobytes())
