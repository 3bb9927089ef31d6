#!/bin/bash
# steps.sh PROGRAM SOURCE ROTATIONS: the steps of install/ci, those of action.yml and of gitlab.yml as they stand there, on a
# release that is a folder.
set -eu
program=$1 source=$2 rotations=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() {
  echo "steps.sh: $*"
  exit 1
}
expect() {  # CODE WORDS COMMAND...
  local code=$1 words=$2 is=0
  shift 2
  "$@" >said 2>&1 || is=$?
  [ $is = "$code" ] && grep -qe "$words" said || fail "$*: exit code $is, and not $code with '$words': $(head -c 2000 said)"
}
steps() {
  sh "$source/install/ci/liecheck_ci.sh" "$@"
}

version=$("$program" --version | head -n 1)
name=liecheck-$version-linux-x86_64
mkdir -p "$name/bin" release
cp "$program" "$name/bin/liecheck"
tar -cf - "$name" | gzip -1 >"release/$name.tar.gz"
(cd release && sha256sum "$name.tar.gz" >SHA256SUMS)

expect 0 "^$version" steps get "$version" release to
expect 0 "^$version" steps get "$version" nowhere to
expect 2 "cannot copy nowhere/liecheck-9.9.9-" steps get 9.9.9 nowhere other
expect 0 "^$version" steps get "$version" "file://$work/release" by_url
expect 2 "cannot get file:///nowhere/" steps get "$version" file:///nowhere by_url2
mkdir broken
echo broken >"broken/$name.tar.gz"
cp release/SHA256SUMS broken
expect 2 "has not the sum" steps get "$version" broken other
[ ! -e other ] || fail "a broken tarball is unpacked"
expect 2 "expected get, test, comment or verdict" steps
expect 2 "unknown step 'go'" steps go away
expect 2 "run the step test first" steps verdict nowhere

expect 0 "^verdict pass" steps test to page "$rotations" --cases 200
expect 0 "liecheck: pass" steps comment page
steps verdict page || fail "the verdict of a pass"
[ -s page/report.html ] && [ -s page/badge.svg ] || fail "no page or no badge"
expect 0 "cannot" steps test to page nothing.so
if steps verdict page; then fail "the verdict without a library"; fi

# The action, as GitHub runs it.
export FROM=release VERSION=$version FLAGS="--cases 200" PAGE=action ADAPTER=$rotations RUNNER_TEMP=$work/temp
export STEPS=$source/install/ci/liecheck_ci.sh GITHUB_STEP_SUMMARY=summary GITHUB_OUTPUT=output GITHUB_PATH=path RELEASE=nowhere
mkdir temp
sed -n '/ run: |/,/^    - /s/^        //p' "$source/action.yml" >action.sh
[ "$(wc -l <action.sh)" -ge 5 ] || fail "no steps in action.yml"
expect 0 "^verdict pass" bash -e action.sh
[ "$(cat output path)" = "code=0
$work/temp/liecheck/bin" ] || fail "outputs of the action: $(cat output path)"
grep -q "liecheck: pass" summary || fail "the summary: $(cat summary)"

# GitLab, with the example in Python, which has a fault.
cp "$source/fixtures/adapters/rotations.py" adapter.py
cp "$source/install/ci/liecheck_ci.sh" .
sed -n 's/^    - \(sh liecheck_ci.*\)/\1/p' "$source/install/ci/gitlab.yml" | sed 's|"python3 |"/usr/bin/python3 |' >gitlab.sh
[ "$(wc -l <gitlab.sh)" = 3 ] || fail "no steps in gitlab.yml"
LIECHECK_VERSION=$version LIECHECK_FROM=release expect 1 "log3_matrix" bash -e gitlab.sh

# A tag is the version.
sed -n 's/^      - run: \(grep .*\)/\1/p' "$source/.github/workflows/release.yml" >tag.sh
[ "$(wc -l <tag.sh)" = 1 ] || fail "no comparison of the tag in release.yml"
cd "$source"
GITHUB_REF_NAME=v$version sh -e "$work/tag.sh" || fail "the tag v$version is refused"
if GITHUB_REF_NAME=v9.9.9 sh -e "$work/tag.sh"; then fail "the tag v9.9.9 is taken"; fi
