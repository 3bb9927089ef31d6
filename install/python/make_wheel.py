#!/usr/bin/env python3
"""make_wheel.py --program P --version V --out DIR: a wheel of the package beside this file and the program
P."""
import argparse
import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
# The libraries of every Linux on which a wheel may be installed (PEP 600), and pip's name of each machine.
OF_THE_SYSTEM = "libc.so.6", "libm.so.6", "libdl.so.2", "libpthread.so.0", "librt.so.1", "libgcc_s.so.1"
MACHINES = {"Advanced Micro Devices X86-64": "x86_64", "AArch64": "aarch64", "RISC-V": "riscv64"}
METADATA = """Metadata-Version: 2.1
Name: liecheck
Version: {version}
Summary: Finds numerical bugs in SE(3) and rigid-body code
License: BSD-3-Clause
License-File: LICENSE
Requires-Python: >=3.9
Requires-Dist: numpy
Classifier: Framework :: Pytest
Classifier: Operating System :: POSIX :: Linux
Classifier: Topic :: Scientific/Engineering
Classifier: Topic :: Software Development :: Testing
Description-Content-Type: text/markdown

{description}"""
WHEEL = """Wheel-Version: 1.0
Generator: make_wheel.py
Root-Is-Purelib: false
Tag: py3-none-{platform}
"""
ENTRY_POINTS = """[console_scripts]
liecheck = liecheck.__main__:main

[pytest11]
liecheck = liecheck.pytest_plugin
"""


def read_elf(program, *flags):
    try:
        return subprocess.run(
            ["readelf", "--wide", *flags, program], check=True, capture_output=True, text=True
        ).stdout
    except FileNotFoundError:
        sys.exit("make_wheel.py: readelf is missing (Debian: binutils)")
    except subprocess.CalledProcessError as error:
        sys.exit(f"make_wheel.py: {program}: {error.stderr.strip()}")


def platform_of(program):
    """The tag of the platforms where the program runs: from its machine, its libraries and glibc's newest
    symbol in it."""
    header = re.search(r"Machine: +(.*)", read_elf(program, "--file-header"))
    if not header or header[1] not in MACHINES:
        sys.exit(f"make_wheel.py: {program} is no program of {', '.join(MACHINES.values())}")
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", read_elf(program, "--dynamic"))
    others = [n for n in needed if n not in OF_THE_SYSTEM and not n.startswith("ld-linux")]
    if others:
        print(
            f"make_wheel.py: {program} needs {', '.join(others)}: the wheel is for this machine alone",
            file=sys.stderr,
        )
        return f"linux_{MACHINES[header[1]]}"
    newest = max(
        (int(minor) for minor in re.findall(r"GLIBC_2\.(\d+)", read_elf(program, "--version-info"))),
        default=17,
    )
    return f"manylinux_2_{newest}_{MACHINES[header[1]]}"


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    for flag in ("--program", "--version", "--out"):
        arguments.add_argument(flag, required=True)
    arguments = arguments.parse_args()
    platform, info = platform_of(arguments.program), f"liecheck-{arguments.version}.dist-info"
    wheel = pathlib.Path(arguments.out, f"liecheck-{arguments.version}-py3-none-{platform}.whl")
    wheel.parent.mkdir(parents=True, exist_ok=True)
    files = {f"liecheck/{file.name}": file.read_bytes() for file in sorted((HERE / "liecheck").glob("*.py"))}
    files["liecheck/_bin/liecheck"] = pathlib.Path(arguments.program).read_bytes()
    files[f"{info}/LICENSE"] = (HERE.parents[1] / "LICENSE").read_bytes()
    files[f"{info}/METADATA"] = METADATA.format(
        version=arguments.version, description=(HERE / "README.md").read_text()
    ).encode()
    files[f"{info}/WHEEL"] = WHEEL.format(platform=platform).encode()
    files[f"{info}/entry_points.txt"] = ENTRY_POINTS.encode()
    record = ""
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:

        def write(name, data):
            entry = zipfile.ZipInfo(name)  # of 1980, so that the same files make the same wheel
            entry.external_attr = (0o100755 if name.endswith("/_bin/liecheck") else 0o100644) << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)

        for name, data in files.items():
            write(name, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{name},sha256={digest},{len(data)}\n"
        write(f"{info}/RECORD", record + f"{info}/RECORD,,\n")
    print(wheel)


if __name__ == "__main__":
    main()
