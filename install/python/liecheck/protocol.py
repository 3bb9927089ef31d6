"""The process protocol of docs/adapters.md: answers calls on standard input until it ends."""
import json
import mmap
import os
import signal
import sys
import time
from typing import Any, Callable, NamedTuple, Optional

import numpy as np

from liecheck.errors import Wrong, in_words
from liecheck.program import ends_with_its_parent

STARTING, PROBING, WAITING, CALLING = range(4)  # what a worker does
REFUSALS = ArithmeticError, ValueError, NotImplementedError, AssertionError, np.linalg.LinAlgError
TYPES = {"float": np.dtype("<f4"), "double": np.dtype("<f8")}


class Function(NamedTuple):
    """An operation on flat arrays: one takes the numbers of an input to those of its result, many takes many
    inputs, one in each row. prepared makes of an input, or of many, a function and its arguments, in the
    library's own types, which is timed. One of REFUSALS refuses the input; any other exception is a crash."""

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
            rounded(
                function.many(inputs[i : i + 1])[0] if function.many else function.one(inputs[i]), results[i]
            )
        except REFUSALS as error:
            status[i], why = 1, " " + reason(error)
    return results, status, why


def answered(calls):
    """As many calls, of those alone that do not refuse their input, as they may some orders of Euler angles."""
    some = []
    for f, arguments in calls:
        try:
            f(*arguments)
            some.append((f, arguments))
        except REFUSALS as error:
            why = error
    if not some:
        raise why
    return [some[i % len(some)] for i in range(len(calls))]


def timed(function, how, inputs, passes):
    """The processor time [ns] of passes over all inputs: of one call each, of one call of all, or of a
    function that returns its argument."""
    prepared = function.prepared or (lambda x: (function.one, (x,)))
    if how == "nothing":
        prepared = lambda x: (lambda y: y, (x,))
    calls = answered([prepared(x) for x in ([inputs] if how == "many" else inputs)])
    start = time.thread_time_ns()
    for _ in range(passes):
        for f, arguments in calls:
            f(*arguments)
    return time.thread_time_ns() - start


def answer(
    description: dict, functions: dict, open_model: Optional[Callable[[Any], dict]] = None, state=bytearray(1)
):
    """functions: operation -> Function; open_model: those of the operations on a model, which one of REFUSALS
    or a KeyError refuses. state: of supervised()."""
    calls, answers = os.fdopen(0, "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what the library prints must not come between the answers
    sys.stdout = sys.stderr

    def say(line, *data):
        answers.write(b"".join([line.encode(), b"\n", *data]))
        answers.flush()

    if state[0] <= PROBING:
        calls.readline()  # "liecheck 1"
        say(json.dumps({"protocol": 1, **description}))
    state[0], of_model = WAITING, {}
    for line in iter(calls.readline, b""):
        state[0] = CALLING
        if line.startswith(b"model "):
            try:
                of_model, said = open_model(json.loads(line[6:])), ["done"]
            except (*REFUSALS, KeyError) as error:
                said = ["refused " + reason(error)]
        else:
            said = answer_to(line.decode().split(), {**functions, **of_model}, calls)
        state[0] = WAITING
        say(*said)


def answer_to(words, functions, calls):
    """Words such as "call exp3_matrix double 128" or "time one exp3_matrix double 256 10", whose inputs come
    from `calls`."""
    how, passes = (words.pop(1), int(words.pop())) if words[0] == "time" else ("", 0)
    function, kind, n = functions[words[1]], TYPES[words[2]], int(words[3])
    data = bytearray(calls.read(n * function.arguments * kind.itemsize))
    inputs = np.frombuffer(data, kind).reshape(n, function.arguments)
    try:
        if how:
            return [f"timed {timed(function, how, inputs, passes)}"]
        results, status, why = call(function, inputs)
        return [f"done {n}{why}", status, results.tobytes()]
    except Wrong as wrong:
        return [f"crashed {wrong}"]
    except (Exception, SystemExit) as error:
        return ["crashed " + in_words(error)]


def supervised(serve):
    """Calls serve(state), which answers, in a process of its own, and again if a call ends it, so that this
    costs no new start of Python. Returns the exit code."""
    state = mmap.mmap(-1, 1)
    while True:
        worker = os.fork()
        if worker == 0:
            ends_with_its_parent(signal.SIGKILL)
            return serve(state) or 0
        code = os.waitstatus_to_exitcode(os.waitpid(worker, 0)[1])
        if state[0] == CALLING:
            ending = f"signal {-code} ({signal.strsignal(-code)})" if code < 0 else f"exit code {code}"
            os.write(1, f"crashed the call ended the process by {ending}\n".encode())
        elif state[0] != PROBING:
            return code if code >= 0 else 128 - code
