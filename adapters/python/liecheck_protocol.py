"""Functions of flat arrays, for the Python adapters of this folder."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "install/python"))
from liecheck import protocol


def serve(name, version, functions, many=(), own={}):
    """functions: operation -> (function, arguments, results, program). A function takes the numbers of one
    input, in double, and returns those of its result. One that raises an exception refuses the input. The
    program, which may be left out, is the same call for a user of the library, with {phi} and so on for the
    numbers. many: the operations whose functions take an array of inputs, too, one in each row, which is
    timed. own: operation -> a function that makes of an input the library's own function and its arguments,
    in the library's own types, which is timed instead."""

    def flat(function, size):
        return lambda x: np.reshape(function(x), size)

    protocol.answer(
        {
            "name": name,
            "version": version,
            "operations": {operation: ["double"] for operation in functions},
            "source": {operation: f[3] for operation, f in functions.items() if len(f) > 3},
            "timed": {o: "one" + ", many" * (o in many) + ", own types" * (o in own) for o in functions},
        },
        {
            o: protocol.Function(
                f[1], f[2], flat(f[0], f[2]), prepared=own.get(o, lambda x, f=f[0]: (f, (x,)))
            )
            for o, f in functions.items()
        },
    )
