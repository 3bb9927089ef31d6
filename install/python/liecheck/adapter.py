"""A class, an instance or a module as an adapter: its functions that are operations, which take and give
NumPy arrays."""
import difflib
import inspect
import os
import re
import sys

import numpy as np

from liecheck import protocol
from liecheck.errors import Wrong, in_words, near
from liecheck.operations import signatures

SCALARS = {"float32": "float", "float": "float", "float64": "double", "double": "double"}
INTEGERS = "order", "wrench_joint", "seen", "joint"
EXAMPLES = {
    "order": 11,
    "t": 0.25,
    "dt": 0.01,
    "mass": 2,
    "axis": (0.6, 0, 0.8),
    "a": (0.6, 0, 0.8),
    "b": (0, 0.6, 0.8),
    "r": (0.8, 0.6),
    "I_C": np.diag([0.3, 0.4, 0.5]),
    "Sigma": np.eye(6),
    "weights": (0.2, 0.3, 0.5),
}


def given(value, x):
    """What a function takes for the numbers in the last axis of x."""
    lead = x.shape[:-1]
    if value.kind == "pose":
        X = np.zeros(lead + (4, 4), x.dtype)
        X[..., :3, :3], X[..., :3, 3], X[..., 3, 3] = x[..., :9].reshape(lead + (3, 3)), x[..., 9:], 1
        return X
    if value.shape is None:
        return tuple(split(value.parts, x))
    if value.name in INTEGERS:
        return x[..., 0].astype(int)[()]
    return x.reshape(lead + value.shape)[()]


def split(values, x):
    """What a function takes for each of the values."""
    ends = np.cumsum([value.size for value in values])
    return [given(value, x[..., end - value.size : end]) for value, end in zip(values, ends)]


def numbers(value, y, lead, who, of=None):
    """The numbers of what a function gave, one row for each input if lead is the number of inputs and not
    ()."""
    if value.parts and isinstance(y, (tuple, list)) and len(y) == len(value.parts):
        return np.concatenate(
            [numbers(part, z, lead, who, value) for part, z in zip(value.parts, y)], axis=-1
        )
    shape = value.shape if value.shape is None else lead + value.shape
    try:
        a = np.asarray(y)
        fits = a.dtype.kind in "fiub" and (a.shape == shape or value.size == 1 and a.shape == lead + (1,))
    except ValueError:  # rows of different lengths
        fits = False
    if not fits:
        what = (
            f"an array of shape {y.shape}" + f" of {y.dtype}" * (y.dtype.kind not in "fiub")
            if isinstance(y, np.ndarray)
            else "None"
            if y is None
            else f"a {type(y).__name__}" + (f" of {len(y)}" if isinstance(y, (tuple, list)) else "")
        )
        many = f" for each of {lead[0]} inputs" if lead else ""
        raise Wrong(f"{who} gave {what}{f' in its {of.name}' if of else ''}, where {value.words()}{many}")
    if value.kind == "pose":
        last = a[..., 3, :]
        if np.isfinite(last).all() and abs(last - (0, 0, 0, 1)).max() > 1e-3:
            raise Wrong(
                f"{who} gave a pose whose last row is {last.reshape(-1, 4)[0].tolist()}, and not 0 0 0 1"
            )
        return np.concatenate([a[..., :3, :3].reshape(lead + (9,)), a[..., :3, 3]], axis=-1)
    return a.reshape(lead + (value.size,))


def example(value):
    """Numbers at which every function has a result."""
    if value.parts:
        return np.concatenate([example(part) for part in value.parts])
    if value.name in EXAMPLES:
        return np.ravel(EXAMPLES[value.name]).astype(float)
    if value.kind == "4":
        return np.array([0.1, -0.3, 0.5, 0.806225774829855])
    if value.kind == "3x3" and value.name in "RA":
        return np.array([0.6, 0, 0.8, 0, 1, 0, -0.8, 0, 0.6])
    return 0.1 * np.arange(1, value.size + 1)


def takes(function, count):
    """Whether a function can be called with so many arguments; True if Python does not know."""
    try:
        inspect.signature(function).bind(*range(count))
    except TypeError:
        return False
    except ValueError:
        return True
    return True


class Bound:
    """A function of the user as an operation. If it takes as many arguments as these have parts, it gets the
    parts."""

    def __init__(self, who, function, arguments, result, batch):
        self.who, self.function, self.result, self.batch = who, function, result, batch
        parts = [part for value in arguments for part in value.parts or [value]]
        if not takes(function, len(arguments)):
            if not takes(function, len(parts)):
                words = ", ".join(value.words() for value in arguments)
                raise Wrong(f"{who} does not take {len(arguments)} arguments: {words}")
            arguments = parts
        self.arguments, self.size = arguments, sum(value.size for value in arguments)

    def __call__(self, x):
        y = self.function(*split(self.arguments, x))
        return (
            numbers(self.result, y, x.shape[:-1], self.who) if self.result else np.empty(x.shape[:-1] + (0,))
        )

    def served(self):
        return protocol.Function(
            self.size,
            self.result.size if self.result else 0,
            self,
            self if self.batch else None,
            lambda x: (self.function, self.split(x)),
        )

    def split(self, x):
        """The arguments of the function for one input, or for one in each row."""
        return split(self.arguments, x[None] if self.batch and x.ndim == 1 else x)

    def probe(self):
        """Calls it once, so that a wrong shape is said before a campaign begins."""
        x = np.concatenate([example(value) for value in self.arguments])
        try:
            self(x[None] if self.batch else x)
        except protocol.REFUSALS:
            pass
        except Exception as error:
            raise Wrong(f"{self.who} raised {in_words(error)}") from None


def functions_of(owner, known, who):
    """operation -> (function, flags): those that the decorator names, and those whose names are
    operations."""
    found = {}
    for name in dir(owner):
        static = inspect.getattr_static(owner, name)
        static = getattr(static, "__func__", static)
        marked = getattr(static, "liecheck_operation", None)
        operations, flags = marked if isinstance(marked, tuple) else ((name,), {})
        if isinstance(static, property) or not callable(static):
            continue
        for operation in operations:
            if operation not in known:
                continue
            function = getattr(owner, name)
            if (
                inspect.ismethod(function)
                and not inspect.isclass(function.__self__)
                and next(iter(inspect.signature(function.__func__).parameters), "") != "self"
            ):
                function = function.__func__  # a function of a library in the body of a class
            if operation in found and found[operation][1] is not function:
                raise Wrong(f"{who} has two functions for {operation}: {found[operation][0]} and {name}")
            found[operation] = name, function, flags
    return found


def texts(value, who):
    """A list of words, of a list or of a text with commas."""
    words = value.split(",") if isinstance(value, str) else value
    if not isinstance(words, (list, tuple)) or not all(isinstance(word, str) for word in words):
        raise Wrong(f"{who} is {value!r}, where a text or a list of texts is due")
    return [word.strip() for word in words]


def scalars_in(value, who):
    names = texts(value, who)
    for name in names:
        if name not in SCALARS:
            raise Wrong(f"{who} has {name!r}, where float32 or float64 is due")
    return sorted({SCALARS[name] for name in names})


def conventions_of(owner, who):
    stated = getattr(owner, "conventions", {})
    if isinstance(stated, dict) or inspect.ismodule(owner) and not isinstance(stated, str):
        return stated if isinstance(stated, dict) else {}
    pairs = [[word.strip() for word in text.split(":", 1)] for text in texts(stated, f"{who}.conventions")]
    if any(len(pair) != 2 for pair in pairs):
        raise Wrong(
            f"{who}.conventions is {stated!r}, where a text such as 'quaternion: wxyz, twist: angular first' "
            "is due"
        )
    return dict(pairs)


def arrays(model):
    """The model with arrays in the place of lists of numbers."""
    if isinstance(model, dict):
        return {
            name: np.reshape(value, (3, 3)) if name == "I_C" else arrays(value)
            for name, value in model.items()
        }
    if isinstance(model, list) and model and not isinstance(model[0], (dict, str)):
        return np.array(model, float)
    return [arrays(item) for item in model] if isinstance(model, list) else model


class Adapter:
    """What an object offers. target: how a program finds the object again, for the programs that failures are
    printed with."""

    def __init__(self, owner, target=""):
        self.who = getattr(owner, "__name__", type(owner).__name__)
        if inspect.isclass(owner):
            try:
                owner = owner()
            except Exception as error:
                raise Wrong(f"{self.who}() raised {in_words(error)}") from None
        self.owner, self.target = owner, target
        self.conventions = conventions_of(owner, self.who)
        self.name = re.sub(r"[^A-Za-z0-9_-]", "_", self.text(owner, "name", self.who.split(".")[-1]))
        self.version = self.text(owner, "version", self.text(owner, "__version__", ""))
        batch = getattr(owner, "batch", False) is True
        scalars = "float64" if inspect.ismodule(owner) else getattr(owner, "scalars", "float64")
        self.bound, self.scalars, self.of_model = {}, {}, {}
        shapes = signatures(quaternion_poses=self.conventions.get("pose form") == "quaternion")
        for operation, (name, function, flags) in functions_of(owner, shapes, self.who).items():
            self.bound[operation] = Bound(
                f"{self.who}.{name}", function, *shapes[operation], flags.get("batch", batch)
            )
            self.scalars[operation] = scalars_in(flags.get("scalars", scalars), f"{self.who}.scalars")
        self.model = getattr(owner, "Model", None)
        if inspect.isclass(self.model):
            self.of_model = functions_of(self.model, signatures((1, 1)), f"{self.who}.Model")
            for operation, (name, _, flags) in self.of_model.items():
                self.scalars[operation] = scalars_in(flags.get("scalars", scalars), f"{self.who}.scalars")
        self.trees = {
            member: texts(getattr(owner, member), f"{self.who}.{member}")
            for member in ("models", "joints", "references")
            if self.of_model and hasattr(owner, member)
        }
        if not self.scalars:
            raise Wrong(
                f"{self.who} has no function that is an operation{self.like(owner, shapes)}: docs/operations.md "
                "lists the operations"
            )

    @staticmethod
    def text(owner, name, otherwise):
        value = getattr(owner, name, otherwise)
        return value if isinstance(value, str) else otherwise

    @staticmethod
    def like(owner, known):
        names = [
            name for name in dir(owner) if not name.startswith("_") and callable(getattr(owner, name, None))
        ]
        like = next((f" ({name}{found})" for name in names if (found := near(name, known))), "")
        return like or f" (it has {', '.join(names[:5])})" * bool(names)

    def misspelt(self):
        """'name (is it operation?)', of the functions that have nearly the name of an operation."""
        known = list(signatures())
        names = [
            name
            for name in dir(self.owner)
            if name not in known and not name.startswith("_") and callable(getattr(self.owner, name, None))
        ]
        found = [(name, difflib.get_close_matches(name, known, 1, 0.85)) for name in names]
        return [f"{name} (is it {like[0]}?)" for name, like in found if like and like[0] not in self.bound]

    def description(self):
        """The line of the protocol."""
        arguments = {o: ", ".join(f"{{{v.name}}}" for v in signatures()[o][0]) for o in self.bound}
        return {
            "name": self.name,
            "version": self.version,
            "operations": self.scalars,
            "conventions": self.conventions,
            "timed": {o: "one" + ", many" * f.batch + ", own types" for o, f in self.bound.items()},
            "source": {
                o: f"import liecheck\nprint(liecheck.call({self.target!r}, '{o}', [{places}]))"
                for o, places in arguments.items()
                if self.target
            },
            **({"trees": self.trees} if self.trees else {}),
        }

    def call(self, operation, x):
        """What the function of an operation gives for these numbers."""
        bound = self.bound[operation]
        return bound.function(*bound.split(np.array(x, float)))

    def open_model(self, model):
        model = arrays(model)
        shapes, opened = signatures((model["nq"], model["nv"])), self.model(model)
        found = functions_of(opened, shapes, f"{self.who}.Model")
        return {
            operation: Bound(f"{self.who}.Model.{name}", function, *shapes[operation], False).served()
            for operation, (name, function, _) in found.items()
        }

    def serve(self, state):
        """Probes the functions, and answers. A crash of the probe is found again by a call."""
        if state[0] == protocol.STARTING:
            if os.environ.get("LIECHECK_LOOK"):  # of the command line, which serves an adapter once before it starts
                for name in self.misspelt():
                    print(f"liecheck: {self.who} has no operation {name}", file=sys.stderr)
            state[0] = protocol.PROBING
            try:
                for bound in self.bound.values():
                    bound.probe()
            except Wrong:
                state[0] = protocol.STARTING
                raise
        protocol.answer(
            self.description(), {o: b.served() for o, b in self.bound.items()}, self.open_model, state
        )
