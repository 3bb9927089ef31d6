"""The program liecheck that this package starts."""
import ctypes
import os
import pathlib
import platform
import shlex
import shutil
import sys

from liecheck.errors import Wrong

BUNDLED = pathlib.Path(__file__).parent / "_bin/liecheck"


def path():
    """LIECHECK_PROGRAM, the program in this package, or that in PATH."""
    named = os.environ.get("LIECHECK_PROGRAM")
    found = named or (str(BUNDLED) if BUNDLED.exists() else shutil.which("liecheck"))
    if not found or not shutil.which(found):
        raise Wrong(
            f"there is no program {named or 'liecheck'}: install the wheel of this machine, or set "
            "LIECHECK_PROGRAM to its path"
        )
    return found


def not_for_this_machine(error):
    return Wrong(
        f"{path()} is no program for this machine, {platform.system()} {platform.machine()}: {error.strerror}"
    )


LIBC = ctypes.CDLL(None)


def ends_with_its_parent(signal):
    """This process gets the signal when its parent ends."""
    LIBC.prctl(1, signal)  # PR_SET_PDEATHSIG


def serves():
    """What the command that serves a target has before it."""
    return f"exec {shlex.quote(sys.executable)} -m liecheck serve "


def serving(target):
    """The command that serves what a target names."""
    return serves() + shlex.quote(target)


def environment():
    """The environment of the program, which prints the commands that a user of this package types."""
    called = f"{pathlib.Path(sys.executable).name} -m liecheck"
    return {**os.environ, "LIECHECK_CALLED_AS": called, "LIECHECK_SERVES": serves()}
