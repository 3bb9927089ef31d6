#!/bin/sh
# recipes.sh VERSION SOURCE: every recipe names this version, and those of vcpkg and Conan package an installed liecheck.
# Neither is there, so stand-ins give them what they call.
set -eu
version=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
  echo "recipes.sh: $*"
  exit 1
}
says() {  # FILE LINE
  grep -qF -- "$2" "$source/$1" || fail "$1 has no '$2'"
}
minor=${version%.*}
rules=$(basename "$(ls "$source"/fixtures/rules/*.txt | sort -V | tail -n 1)" .txt)
says action.yml "    default: $version"
says install/ci/github.yml "@v$version"
says install/ci/gitlab.yml "LIECHECK_VERSION: $version"
says install/ci/github.yml "--rules $rules"
says install/ci/gitlab.yml "--rules $rules"
says install/ci/Containerfile "-t liecheck:$minor "
says install/ci/workflow.yml "/liecheck:$minor"
says install/vcpkg/vcpkg.json "\"version\": \"$version\""
says install/conan/conanfile.py "version = \"$version\""
says CHANGELOG.md "## $version"
says docs/building.md "liecheck-$version-linux-x86_64.tar.gz"
says docs/adapters.md "find_package(liecheck $minor REQUIRED"

name=liecheck-$version-linux-x86_64
mkdir -p "$work/$name/include" "$work/$name/lib" "$work/$name/bin" "$work/$name/share/doc/liecheck" "$work/port" "$work/conan/tools"
for file in include/liecheck.h lib/libliecheck_lib.a bin/liecheck share/doc/liecheck/LICENSE; do echo "$file" >"$work/$name/$file"; done
chmod +x "$work/$name/bin/liecheck"
tar -czf "$work/port/$name.tar.gz" -C "$work" "$name"
(cd "$work/port" && sha256sum "$name.tar.gz" >SHA256SUMS)
port() {
  cmake -D VERSION="$version" -D CURRENT_PORT_DIR="$work/port" -D CURRENT_BUILDTREES_DIR="$work/trees" \
    -D CURRENT_PACKAGES_DIR="$work/packages" -P "$source/install/vcpkg/portfile.cmake" >"$work/said" 2>&1
}
port || fail "vcpkg: $(cat "$work/said")"
[ -x "$work/packages/bin/liecheck" ] && [ -s "$work/packages/share/liecheck/copyright" ] || fail "vcpkg: $(find "$work/packages")"

cat >"$work/conan/__init__.py" <<'END'
class ConanFile:
    pass
END
echo "class ConanInvalidConfiguration(Exception): pass" >"$work/conan/errors.py"
: >"$work/conan/tools/__init__.py"
cat >"$work/conan/tools/files.py" <<'END'
import hashlib, shutil
def check_sha256(recipe, path, sum):
    with open(path, "rb") as file:
        if hashlib.sha256(file.read()).hexdigest() != sum:
            raise ValueError(f"{path}: another sum")
def copy(recipe, pattern, src, dst):
    shutil.copytree(src, dst, dirs_exist_ok=True)
END
cat >"$work/package.py" <<'END'
import sys
sys.path[:0] = [sys.argv[1], sys.argv[2]]
import types
from conanfile import ConanInvalidConfiguration, Liecheck
recipe = Liecheck()
recipe.source_folder, recipe.build_folder, recipe.package_folder = (f"{sys.argv[1]}/{f}" for f in ("port", "built", "packaged"))
for system, fits in (("Linux", True), ("Windows", False)):
    recipe.settings = types.SimpleNamespace(os=system, arch="x86_64")
    try:
        recipe.validate()
        assert fits
    except ConanInvalidConfiguration:
        assert not fits
recipe.package()
END
conan() {
  /usr/bin/python3 -B "$work/package.py" "$work" "$source/install/conan" >"$work/said" 2>&1
}
conan || fail "conan: $(cat "$work/said")"
[ -x "$work/packaged/bin/liecheck" ] && [ -s "$work/packaged/lib/libliecheck_lib.a" ] || fail "conan: $(find "$work/packaged")"

# Both refuse a tarball that is not the released one.
echo more >>"$work/port/$name.tar.gz"
if port; then fail "vcpkg takes a changed tarball"; fi
tr -s "\n " " " <"$work/said" | grep -q "SHA256SUMS does not have" || fail "vcpkg: $(cat "$work/said")"
if conan; then fail "conan takes a changed tarball"; fi
