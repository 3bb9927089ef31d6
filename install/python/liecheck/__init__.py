"""liecheck for Python: an adapter is a class, an instance or a module whose functions take and give NumPy
arrays."""
import sys

if sys.version_info < (3, 9):
    raise SystemExit("liecheck needs Python 3.9 or newer, and this is Python %d.%d" % sys.version_info[:2])

from liecheck.operations import signatures as _signatures
from liecheck.subjects import Subject, subject

__all__ = ["Subject", "call", "operation", "subject"]


def operation(*names, **flags):
    """A decorator: this function is these operations, whatever its name is. scalars: "float32", "float64" or
    both; batch: whether it takes arrays of shape (n, ...)."""
    from liecheck.errors import near

    known = {**_signatures(), **_signatures((1, 1))}
    for name in names:
        if name not in known:
            raise ValueError(f"{name!r} is no operation{near(str(name), known)}")
    if not names or set(flags) - {"scalars", "batch"}:
        raise TypeError("liecheck.operation takes names of operations, and the flags scalars and batch")

    def mark(function):
        marked = function if hasattr(function, "__dict__") else lambda *arguments: function(*arguments)
        getattr(marked, "__func__", marked).liecheck_operation = names, flags
        return marked

    return mark


def call(target, name, numbers):
    """What the function of an operation gives, as liecheck calls it: "mylib:MyLib", "exp6", and its
    numbers."""
    from liecheck.subjects import loaded

    return loaded(target).call(name, numbers)
