"""A library under test, in a test file or on a command line."""
import importlib
import importlib.util
import os
import pathlib
import re
import shutil
import sys

from liecheck.errors import Wrong, in_words, near


class Subject:
    """A library and how it is judged: what liecheck.subject() takes."""

    def __init__(self, library, limits, profile, cases, seed, rules):
        self.library, self.limits, self.profile, self.cases, self.seed, self.rules = (
            library,
            limits,
            profile,
            cases,
            seed,
            rules,
        )


def subject(library, *, limits=None, profile=None, cases=1000, seed=42, rules=None):
    """A test function for pytest, one test for each law and scalar of which the library, a class, an instance
    or a module, offers an operation: `test_mylib = liecheck.subject(MyLib())`, at the top of a test file.
    limits: the file of limits, beside the test file; profile and rules as the flags of `liecheck test`; cases
    and seed of each test, unless --liecheck-cases or --liecheck-seed says others."""
    caller = sys._getframe(1)

    def test(request, liecheck_law, liecheck_scalar):
        from liecheck import pytest_plugin

        pytest_plugin.run(request, test.liecheck_subject, liecheck_law, liecheck_scalar)

    if limits is not None:
        limits = str(pathlib.Path(caller.f_code.co_filename).parent / limits)
    test.liecheck_subject = Subject(library, limits, profile, cases, seed, rules)
    test.__code__ = test.__code__.replace(
        co_filename=caller.f_code.co_filename, co_firstlineno=caller.f_lineno
    )
    return test


def is_target(word):
    """Whether a word names Python: mylib:MyLib, mylib, adapter.py or adapter.py:MyLib."""
    module = re.fullmatch(r"([A-Za-z_]\w*(?:\.\w+)*)(:[\w.]+)?", word)
    return bool(
        re.fullmatch(r"[^ ]+\.py(:[\w.]+)?", word)
        or module
        and (module[2] or not shutil.which(word) and _found(word.split(".")[0]))
    )


def _found(module):
    try:
        return importlib.util.find_spec(module) is not None
    except (ImportError, ValueError):
        return False


def module_of_file(text):
    """Imports a file as pytest does: its folder, or that above its package, is where other modules are
    found."""
    path = pathlib.Path(text).resolve()
    if not path.is_file():
        raise Wrong(f"there is no file {text}")
    name, root = path.stem, path.parent
    while (root / "__init__.py").exists():
        name, root = f"{root.name}.{name}", root.parent
    sys.path.insert(0, str(root))
    spec = importlib.util.spec_from_file_location(name, path)
    module = sys.modules[name] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def loaded(target):
    """The adapter of what a target names."""
    from liecheck.adapter import Adapter

    place, _, attribute = target.partition(":")
    try:
        owner = module_of_file(place) if place.endswith(".py") else importlib.import_module(place)
    except ModuleNotFoundError as error:
        if error.name and (place + ".").startswith(error.name + "."):
            raise Wrong(f"there is no module {error.name!r} in {os.getcwd()} or on Python's path") from None
        raise Wrong(f"{place} cannot be imported: {in_words(error)}") from None
    except Exception as error:
        raise Wrong(f"{place} cannot be imported: {in_words(error)}") from None
    for name in attribute.split(".") if attribute else []:
        if not hasattr(owner, name):
            raise Wrong(f"{place} has no {attribute!r}{near(name, dir(owner))}")
        owner = getattr(owner, name)
    made = getattr(owner, "liecheck_subject", None)
    return Adapter(made.library if isinstance(made, Subject) else owner, target)
