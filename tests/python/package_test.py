"""package_test.py PROGRAM FOLDER VERSION: the Python package, built and installed from a wheel in FOLDER,
with pytest."""
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
import unittest

PROGRAM, FOLDER, VERSION = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
VENV, PROJECT = FOLDER / "venv", FOLDER / "project"
PYTHON = VENV / "bin/python"
ENVIRONMENT = {
    **{n: v for n, v in os.environ.items() if n not in ("PYTHONPATH", "LIECHECK_PROGRAM")},
    "LIECHECK_TREES": str(ROOT / "fixtures/adapters/trees"),
    "PYTHONDONTWRITEBYTECODE": "1",
}


def run(*command, code=0, folder=PROJECT, **more):
    """What a command says, which must end with this code, or with any if it is None."""
    done = subprocess.run(
        [str(word) for word in command], cwd=folder, env=ENVIRONMENT, text=True, capture_output=True, **more
    )
    if code is not None and done.returncode != code:
        raise AssertionError(f"{command} ends with {done.returncode}: {done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def pytest(*flags, code):
    return run(PYTHON, "-m", "pytest", "-p", "no:randomly", *flags, code=code)


def liecheck(*words, code=0):
    return run(PYTHON, "-m", "liecheck", *words, code=code)


def files(folder):
    return {str(path) for path in folder.rglob("*") if "__pycache__" not in str(path)}


def processes():
    """The command lines of the processes that a test may leave behind."""
    return [
        line
        for line in run("ps", "-eo", "args").splitlines()
        if str(PROJECT) in line and "package_test" not in line
    ]


def outcome(said):
    """test -> how it ended, of pytest -v."""
    return dict(re.findall(r"::(\S+\[\S+\]) (PASSED|FAILED|XFAIL|XPASS)", said))


def setUpModule():
    shutil.rmtree(FOLDER, ignore_errors=True)
    PROJECT.mkdir(parents=True)
    for file in (HERE / "test_mylib.py", HERE / "libraries.py", ROOT / "tests/consumer/python/mylib.py"):
        shutil.copy(file, PROJECT)
    run("/usr/bin/python3", "-m", "venv", "--system-site-packages", VENV)
    global BEFORE
    BEFORE = files(VENV)
    run(
        "/usr/bin/python3",
        ROOT / "install/python/make_wheel.py",
        "--program",
        PROGRAM,
        "--version",
        VERSION,
        "--out",
        FOLDER,
    )
    run(VENV / "bin/pip", "install", "--no-index", *FOLDER.glob("liecheck-*.whl"))


def tearDownModule():
    run(VENV / "bin/pip", "uninstall", "--yes", "liecheck")
    left = files(VENV) - BEFORE
    if left or processes():
        raise AssertionError(f"left behind: {left} {processes()}")


class Table(unittest.TestCase):
    def test_operations_are_those_of_the_program(self):
        sys.path.insert(0, str(ROOT / "install/python"))
        from liecheck.operations import signatures

        own, rows = signatures(), {}
        for line in (ROOT / "docs/operations.md").read_text().splitlines():
            columns = re.split(r"(?<!\\)\|", line)
            if len(columns) == 7:
                names = re.sub(r" = \(.*?\)", "", re.sub(r" \[.*?\]", "", columns[3]))
                rows[columns[1].strip()] = [name.strip() for name in names.split(",")]
        interface = ROOT / "properties/adapters"
        for name, takes, gives in re.findall(
            r"N\((\w+), (\d+), (\d+)\)", (interface / "liecheck_operations.inc").read_text()
        ):
            arguments, result = own.pop(name)
            self.assertEqual((sum(a.size for a in arguments), result.size), (int(takes), int(gives)), name)
            self.assertEqual([a.name for a in arguments], rows[name])
        self.assertEqual(set(own), {"check_quaternion", "check_rotation"})
        nq, nv, own = 11, 7, signatures((11, 7))
        for name, counts in re.findall(
            r"N\((\w+), ([\d, ]+)\)", (interface / "liecheck_model_operations.inc").read_text()
        ):
            q, v, one, to_q, to_v, square, to_one = map(int, counts.split(","))
            arguments, result = own.pop(name)
            self.assertEqual(sum(a.size for a in arguments), q * nq + v * nv + one, name)
            self.assertEqual(result.size, to_q * nq + to_v * nv + square * nv * nv + to_one, name)
            self.assertEqual([a.name for a in arguments if a.name != "frame"], rows[name])
        self.assertFalse(own)


class Wheel(unittest.TestCase):
    def test_the_platform_is_that_of_the_program(self):
        (FOLDER / "small.c").write_text(
            "#include <math.h>\nint main(int n, char** x) { return exp(n) > **x; }\n"
        )
        run("cc", "small.c", "-o", "small", "-lm", folder=FOLDER)
        symbols = run("objdump", "-T", "small", folder=FOLDER)
        newest = max(int(minor) for minor in re.findall(r"GLIBC_2\.(\d+)", symbols))
        make = (
            "/usr/bin/python3",
            ROOT / "install/python/make_wheel.py",
            "--version",
            "1.0",
            "--out",
            FOLDER / "dist",
            "--program",
        )
        for _ in range(2):
            name = pathlib.Path(run(*make, FOLDER / "small").strip())
            self.assertEqual(name.name, f"liecheck-1.0-py3-none-manylinux_2_{newest}_x86_64.whl")
            digests = {hashlib.sha256(name.read_bytes()).hexdigest()} | (digests if _ else set())
        self.assertEqual(len(digests), 1)
        self.assertIn("Not an ELF file", run(*make, HERE / "libraries.py", code=1))


class Pytest(unittest.TestCase):
    def tearDown(self):
        for file in ("mylib.limits", "test_other.py", "starts"):
            (PROJECT / file).unlink(missing_ok=True)

    def test_four_faults_are_four_red_tests_that_name_them(self):
        self.assertLessEqual(len((PROJECT / "test_mylib.py").read_text().splitlines()), 25)
        said = pytest("-v", "-n", "2", code=1)
        red = dict(re.findall(r"_ (test_mylib\[\S+\]) _+\n(.*?)\n(?=_{5}|={5})", said, re.DOTALL))
        for law, fault in (
            ("exp_oracle", "exp3_matrix (rotation, orthogonality defect): NaN or Inf"),
            ("small_angle_branches", "exp3_quaternion (jump): 5"),
            ("log_oracle", "log3_quaternion (rotation vector): wrong branch"),
            ("jacobian_oracle", "left_jacobian6 (coupling): all"),
        ):
            self.assertIn(fault, red[f"test_mylib[{law}-double]"])
        self.assertEqual(len(red), 4)
        replay = r"replay +python\S* -m liecheck replay raw\.\S+ --adapter \S*/test_mylib\.py:test_mylib\n"
        self.assertRegex(red["test_mylib[log_oracle-double]"], replay)
        self.assertIn("test_mylib[pose_group-double]", said)
        self.assertNotIn("Traceback", said)
        self.assertRegex(said, "4 failed, [1-9] passed")
        again = pytest("-v", "--lf", "-x", code=1)
        self.assertEqual(len(outcome(again)), 1)
        self.assertRegex(again, "4 items|4 selected|run-last-failure: rerun previous 4 failures")

    def test_tests_are_selected_and_their_seed_and_cases_given(self):
        said = pytest("-v", "-k", "log_oracle", "--liecheck-seed", "7", "--liecheck-cases", "100", code=1)
        self.assertEqual(outcome(said), {"test_mylib[log_oracle-double]": "FAILED"})
        self.assertIn("measured 100 cases of 1 law in double", said)
        self.assertIn("seed 7", said)
        self.assertEqual(
            list(outcome(pytest("-v", "test_mylib.py::test_mylib[pose_group-double]", code=0)).values()),
            ["PASSED"],
        )

    def test_expected_failures_are_xfail(self):
        (PROJECT / "mylib.limits").write_text(
            "version = 3\nsubject = MyLib\nprofile = careful\n[expected]\n"
            "exp3_quaternion, jump, theta 1e-5..1e-3 = a cutoff, https://example.org/1\n"
            "inverse, translation, all = it was wrong, https://example.org/2\n"
        )
        (PROJECT / "test_other.py").write_text(
            "import liecheck\nfrom test_mylib import MyLib\n"
            "test_known = liecheck.subject(MyLib, limits='mylib.limits')\n"
        )
        flags = "-v", "test_other.py", "-k", "small or pose", "-rx"
        said = pytest(*flags, code=0)
        self.assertEqual(
            outcome(said),
            {"test_known[small_angle_branches-double]": "XFAIL", "test_known[pose_group-double]": "XPASS"},
        )
        self.assertIn("a cutoff, https://example.org/1", said)
        said = pytest(*flags, "-o", "xfail_strict=true", code=1)
        self.assertIn("[XPASS(strict)] inverse translation", said)
        self.assertEqual(
            outcome(pytest(*flags, "--runxfail", code=1))["test_known[small_angle_branches-double]"], "FAILED"
        )

    def test_a_crash_is_a_red_test_and_costs_no_new_start(self):
        (PROJECT / "test_other.py").write_text(
            "import liecheck\nfrom libraries import Crash, Forms\n"
            "test_crash = liecheck.subject(Crash, cases=20)\n"
            "test_forms = liecheck.subject(Forms(), cases=200)\n"
        )
        said = pytest("-v", "test_other.py", code=1)
        self.assertEqual(outcome(said).pop("test_crash[quaternions-double]"), "FAILED")
        self.assertIn("quaternion_inverse (rotation): crashed in double", said)
        self.assertIn("the call ended the process by exit code 3", said)
        self.assertEqual({how for name, how in outcome(said).items() if "forms" in name}, {"PASSED"})
        self.assertIn("test_forms[quaternions-float]", outcome(said))
        starts = (
            (PROJECT / "starts").read_text().split()
        )  # of each call, the process that started that of the library
        self.assertGreater(len(starts), 10 * len(set(starts)))

    def test_nothing_is_left_after_an_interrupt(self):
        (PROJECT / "test_other.py").write_text(
            "import liecheck\nfrom libraries import Hang\ntest_hang = liecheck.subject(Hang)\n"
        )
        for how, flags in ((signal.SIGINT, []), (signal.SIGINT, ["-n", "2"]), (signal.SIGKILL, [])):
            with subprocess.Popen(
                [PYTHON, "-m", "pytest", "test_other.py", *flags],
                cwd=PROJECT,
                env=ENVIRONMENT,
                text=True,
                stdout=subprocess.PIPE,
                start_new_session=True,
            ) as session:
                until = time.time() + 60
                while not any("liecheck serve" in line for line in processes()) and time.time() < until:
                    time.sleep(0.1)
                session.send_signal(how)
                said = session.communicate()[0]
            self.assertIn("KeyboardInterrupt" if how == signal.SIGINT else "", said)
            until = time.time() + 8
            while processes() and time.time() < until:
                time.sleep(0.1)
            self.assertEqual(processes(), [])


class CommandLine(unittest.TestCase):
    def test_what_is_wrong_is_one_line(self):
        for target, words in (
            ("nowhere:X", "there is no module 'nowhere'"),
            ("libraries:Shap", "has no 'Shap'; near: Shape"),
            ("libraries:Shape", "Shape.exp3_matrix gave an array of shape (3,), where R has shape (3, 3)"),
            ("libraries:Transposed", "Transposed.inverse gave a pose whose last row is"),
            ("libraries:Nothing", "Nothing.log3_quaternion gave None, where phi has shape (3,)"),
            ("libraries:Misnamed", "Misnamed has no function that is an operation (exp_6; near: exp6)"),
            ("libraries:Foreign", "Foreign.exp3_matrix gave a Foreign, where R has shape (3, 3)"),
            ("libraries:Arity", "Arity.act_point does not take 2 arguments: X has shape (4, 4)"),
            ("libraries:Raises", "Raises.exp3_matrix raised AttributeError"),
            ("libraries:Scalars", "has 'float16', where float32 or float64 is due"),
            ("nofile.py:X", "there is no file nofile.py"),
        ):
            said = liecheck("test", target, code=2).strip()
            self.assertTrue(said.startswith("liecheck: ") and words in said and "\n" not in said, said)
        said = liecheck("test", "libraries:Misspelt", "--cases", "100")
        self.assertIn("liecheck: Misspelt has no operation invers (is it inverse?)\n", said)
        ENVIRONMENT["LIECHECK_PROGRAM"] = str(HERE / "libraries.py")
        try:
            self.assertIn("there is no program", liecheck("list", code=2))
        finally:
            del ENVIRONMENT["LIECHECK_PROGRAM"]

    def test_arrays_have_the_shapes_of_the_operations(self):
        said = liecheck("test", "libraries:Forms", "--cases", "300")
        self.assertIn("verdict pass; forms 2.1", said)
        self.assertIn("in double and float", said)
        said = liecheck("test", "libraries.py:Fault", "--cases", "300", "--no-probe", code=1)
        self.assertIn("1  quaternion_product (rotation)", said)
        numbers = re.search(
            r"print\(liecheck.call\('libraries.py:Fault', 'quaternion_product', \[(.*)\]\)\)", said
        )[1]
        run(
            PYTHON,
            "-c",
            f"import liecheck; print(liecheck.call('libraries.py:Fault', 'quaternion_product', [{numbers}]))",
        )

    def test_trees_are_served(self):
        said = run(VENV / "bin/liecheck", "test", "libraries:Trees", "--cases", "20")
        self.assertIn("verdict pass; Trees", said)
        self.assertIn("frame_jacobian", liecheck("list", "--laws", "--adapter", "libraries:Trees"))

    def test_a_function_is_timed_alone_and_in_batches(self):
        asked = "".join(
            f"time {how} quaternion_product float 2 3\n" + "\0" * 64 for how in ("one", "many", "nothing")
        )
        said = run(PYTHON, "-m", "liecheck", "serve", "libraries:Forms", input="liecheck 1\n" + asked)
        self.assertEqual(
            json.loads(said.splitlines()[0])["timed"]["quaternion_product"], "one, many, own types"
        )
        self.assertEqual(len(re.findall(r"^timed [1-9]\d*$", said, re.MULTILINE)), 3)
        # Calls that are refused, as some orders of Euler angles, are not timed.
        half = struct.pack("<8d", 0, 0, 0, 0, 0, 0, 0, 1).decode("latin1")
        asked = f"liecheck 1\ntime one quaternion_inverse double 2 3\n{half}"
        said = run(PYTHON, "-m", "liecheck", "serve", "libraries:Forms", input=asked, encoding="latin1")
        self.assertRegex(said, r"\ntimed [1-9]\d*\n")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
