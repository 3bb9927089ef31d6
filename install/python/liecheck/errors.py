"""What is wrong with the user's input."""
import difflib
import importlib
import os
import traceback

OTHERS = os.path.dirname(__file__), os.path.dirname(
    importlib.__file__
)  # whose lines say nothing of the user's code


class Wrong(SystemExit):
    """A sentence, with which the process ends if nobody catches it: no library's own `except Exception`
    does."""


def in_words(error):
    """An exception of the user's code, with the line that raised it."""
    frames = [
        f for f in traceback.extract_tb(error.__traceback__) if not f.filename.startswith(("<", *OTHERS))
    ]
    where = f" ({frames[-1].filename}:{frames[-1].lineno})" if frames else ""
    text = " ".join(str(error).split())
    return f"{type(error).__name__}{': ' + text if text else ''}{where}"


def near(name, names):
    """', near: ...' of the names that are like this one, or ''."""
    found = difflib.get_close_matches(name, names, 3)
    return f"; near: {', '.join(found)}" if found else ""
