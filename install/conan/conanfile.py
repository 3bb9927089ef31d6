"""A recipe of Conan 2 that packages a released tarball; docs/building.md says how to use it."""
import os
import tarfile

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.files import check_sha256, copy


class Liecheck(ConanFile):
    """The library, its laws, the headers of adapters, and the program; the tarball and SHA256SUMS stand beside this file."""
    name = "liecheck"
    version = "0.5.0"
    license = "BSD-3-Clause"
    description = "Verifies SE(3) and rigid-body libraries numerically, by properties"
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"
    requires = "eigen/3.4.0", "expat/2.5.0", "yaml-cpp/0.7.0"
    exports_sources = "liecheck-*-linux-x86_64.tar.gz", "SHA256SUMS"

    def validate(self):
        """The tarball exists for one platform."""
        if (str(self.settings.os), str(self.settings.arch)) != ("Linux", "x86_64"):
            raise ConanInvalidConfiguration("liecheck is released for Linux on x86_64 only")

    def package(self):
        """Unpacks the tarball."""
        tree = f"liecheck-{self.version}-linux-x86_64"
        path = os.path.join(self.source_folder, tree + ".tar.gz")
        with open(os.path.join(self.source_folder, "SHA256SUMS"), encoding="ascii") as sums:
            check_sha256(self, path, dict(reversed(line.split()) for line in sums)[tree + ".tar.gz"])
        with tarfile.open(path) as tarball:
            tarball.extractall(self.build_folder)
        copy(self, "*", os.path.join(self.build_folder, tree), self.package_folder)

    def package_info(self):
        """find_package(liecheck) reads the package's own CMake files."""
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "liecheck")]
        self.buildenv_info.append_path("PATH", os.path.join(self.package_folder, "bin"))
