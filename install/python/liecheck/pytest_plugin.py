"""pytest's part: a subject becomes one test for each law and scalar, which the program liecheck runs."""
import functools
import json
import os
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import tempfile

import pytest

from liecheck import program
from liecheck.errors import Wrong

PASSES = 0  # exit code of the program


def pytest_addoption(parser):
    group = parser.getgroup("liecheck")
    group.addoption(
        "--liecheck-seed", type=int, help="seed of each test of liecheck.subject, in place of its own"
    )
    group.addoption(
        "--liecheck-cases", type=int, help="cases of each test of liecheck.subject, in place of its own"
    )


def started(words):
    """Runs the program, which ends with this process, and returns its exit code and what it says. Its adapter
    finds the modules that pytest finds."""
    environment = {**program.environment(), "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    try:
        process = subprocess.Popen(
            [program.path(), *words],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            errors="replace",
            env=environment,
            preexec_fn=lambda: program.ends_with_its_parent(signal.SIGTERM),
        )
    except OSError as error:
        raise program.not_for_this_machine(error) from None
    try:
        said, errors = process.communicate()
    except BaseException:
        process.terminate()
        try:
            process.communicate(timeout=10)
        except subprocess.TimeoutExpired:
            process.kill()
        raise
    return process.returncode, said, errors


@functools.lru_cache(maxsize=None)
def laws_of(description, rules):
    """The laws of which an adapter with this description, a line of the protocol, offers an operation."""
    code, said, errors = started(
        ["list", "--laws", "--adapter", f"read hello; printf '%s\\n' {shlex.quote(description)}", *rules]
    )
    if code:
        raise Wrong(errors.strip())
    return said.split()


def flags_of(subject):
    return [
        word
        for flag in ("limits", "profile", "rules")
        if getattr(subject, flag) is not None
        for word in ("--" + flag, str(getattr(subject, flag)))
    ]


def pytest_generate_tests(metafunc):
    subject = getattr(metafunc.function, "liecheck_subject", None)
    if subject is None:
        return
    try:
        if metafunc.cls:
            raise Wrong("liecheck.subject stands at the top of a module, not in a class")
        from liecheck.adapter import Adapter

        description = Adapter(subject.library).description()
        rules = () if subject.rules is None else ("--rules", str(subject.rules))
        cases = []
        for scalar in ("double", "float"):
            offered = {o: [scalar] for o, scalars in description["operations"].items() if scalar in scalars}
            if offered:
                cases += [
                    (law, scalar)
                    for law in laws_of(
                        json.dumps({"protocol": 1, **description, "operations": offered}), rules
                    )
                ]
    except Wrong as wrong:
        raise pytest.Collector.CollectError(f"{metafunc.definition.name}: {wrong}") from None
    metafunc.parametrize(
        "liecheck_law, liecheck_scalar",
        sorted(cases),
        ids=[f"{law}-{scalar}" for law, scalar in sorted(cases)],
    )


def tested(words):
    """Runs a campaign, and returns its exit code, what it says, and what it says of the failures that are
    expected."""
    with tempfile.TemporaryDirectory() as folder:
        record = pathlib.Path(folder, "record.json")
        code, said, errors = started(["test", *words, "--jobs", "1", "--json", str(record)])
        expected = json.loads(record.read_text())["expected"] if record.exists() else []
    findings = re.findall(r"^\d+  (.*)$", said, re.MULTILINE)  # pytest's summary has the first line
    errors = re.sub(r"^ *\d+ %  .*$", "", errors, flags=re.MULTILINE)  # progress
    said = ["; ".join(findings), said.split("\n--verbose shows")[0].strip(), errors.strip() if code else ""]
    return code, "\n".join(filter(None, said)) or f"liecheck ends with exit code {code}", expected


@functools.lru_cache(maxsize=None)
def passed_everywhere(words):
    """The expected failures that no law finds in any scalar."""
    return [text_of(e) for e in tested(words)[2] if e["passed"]]


def text_of(expected):
    return "{operation} {block}, {inputs}: {reason}, {link}".format(**expected)


def run(request, subject, law, scalar):
    """Fails with what the program prints. A failure that the file of limits expects is that of an xfail mark;
    if no law finds it any more, the test has the mark and passes."""
    option, target = request.config.option, f"{request.module.__file__}:{request.node.originalname}"
    seed, cases = option.liecheck_seed, option.liecheck_cases
    words = [
        program.serving(target),
        "--seed",
        str(subject.seed if seed is None else seed),
        "--cases",
        str(subject.cases if cases is None else cases),
        *flags_of(subject),
    ]
    code, said, expected = tested([*words, "--property", law, "--scalar", scalar])
    if code != PASSES:
        pytest.fail(said, pytrace=False)
    failed, passed = [text_of(e) for e in expected if e["failed"]], [
        text_of(e) for e in expected if e["passed"]
    ]
    if passed and not failed:
        passed = [text for text in passed if text in passed_everywhere(tuple(words))]
    if failed or passed:
        request.node.add_marker(pytest.mark.xfail(reason="; ".join(failed or passed)))
    if failed:
        pytest.fail(said, pytrace=False)
