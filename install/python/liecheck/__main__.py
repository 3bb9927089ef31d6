"""The command line: that of the program liecheck, with names of Python objects as adapters."""
import os
import subprocess
import sys

from liecheck import program
from liecheck.errors import Wrong
from liecheck.subjects import is_target, loaded


def command_of(target):
    """The command that serves a target, which is served once, so that what is wrong with it is said here."""
    command = program.serving(target)
    with subprocess.Popen(
        ["/bin/sh", "-c", command],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env={**os.environ, "LIECHECK_LOOK": "1"},
    ) as p:
        errors = p.communicate(b"liecheck 1\n")[1].decode(errors="replace").strip()
    for line in () if p.returncode else errors.splitlines():
        if line.startswith("liecheck: "):
            print(line, file=sys.stderr)
    if p.returncode:
        last = (
            errors.splitlines()[-1] if errors else f"{target}: its process ends with exit code {p.returncode}"
        )
        raise Wrong(last[len("liecheck: ") :] if last.startswith("liecheck: ") else last)
    return command


def translated(words):
    """The words of a command line, in which targets in the place of an adapter become commands."""
    words = list(words)
    for i in range(1, len(words)):
        flag, equals, value = words[i].partition("=")
        if words[i - 1] in ("test", "--adapter") or words[i - 2 : i] == ["adapter", "check"]:
            words[i] = command_of(words[i]) if is_target(words[i]) else words[i]
        elif flag == "--adapter" and equals and is_target(value):
            words[i] = f"--adapter={command_of(value)}"
    return words


def main():
    words = sys.argv[1:]
    try:
        if words[:1] == ["serve"]:
            if len(words) != 2:
                raise Wrong("serve: one name is due, such as mylib:MyLib")
            from liecheck.protocol import supervised

            return supervised(lambda state: loaded(words[1]).serve(state))
        words = [program.path(), *translated(words)]
        try:
            os.execve(words[0], words, program.environment())
        except OSError as error:
            raise program.not_for_this_machine(error) from None
    except Wrong as wrong:
        print(f"liecheck: {wrong}", file=sys.stderr)
        return 2
    except ModuleNotFoundError as error:
        if error.name != "numpy":
            raise
        print(f"liecheck: NumPy is missing: {sys.executable} -m pip install numpy", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
