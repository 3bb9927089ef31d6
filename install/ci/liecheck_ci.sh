#!/bin/sh
# The steps of a CI job that tests a library with a released liecheck. action.yml, github.yml and gitlab.yml run them; so does
# any other machine with x86-64 Linux, glibc 2.31 or newer, tar, sha256sum, and curl for artefacts that are not in a folder:
#   liecheck_ci.sh get VERSION FROM TO        # unpacks the tarball of FROM (a URL or a folder) into the folder TO, once
#   liecheck_ci.sh test TO PAGE ADAPTER [FLAGS of liecheck test]...
#   liecheck_ci.sh comment PAGE               # prints the Markdown of a comment
#   liecheck_ci.sh verdict PAGE               # exits with the exit code of the test
# PAGE is a folder: it has the record and page of the test, badge.svg, verdict.txt (what was printed) and exit_code.
set -eu

fail() {
  echo "liecheck_ci.sh: $*" >&2
  exit 2
}
[ $# -ge 2 ] || fail "expected get, test, comment or verdict, and its arguments"
step=$1
shift

fetch() {  # FROM/NAME into the folder $3
  case $1 in
    *://*) curl --fail --silent --show-error --location --retry 3 --output "$3/$2" "$1/$2" || fail "cannot get $1/$2" ;;
    *) cp "$1/$2" "$3/$2" || fail "cannot copy $1/$2" ;;
  esac
}

get() {
  [ $# = 3 ] || fail "get: expected VERSION FROM TO"
  version=$1 from=$2 to=$3
  name=liecheck-$version-linux-x86_64
  if [ ! -x "$to/bin/liecheck" ] || [ "$("$to/bin/liecheck" --version | head -n 1)" != "$version" ]; then
    rm -rf "$to" "$to.part"
    mkdir -p "$to.part"
    fetch "$from" "$name.tar.gz" "$to.part"
    fetch "$from" SHA256SUMS "$to.part"
    (cd "$to.part" && grep -F "  $name.tar.gz" SHA256SUMS | sha256sum --check --quiet -) ||
      fail "$from/$name.tar.gz has not the sum that $from/SHA256SUMS says"
    tar -xzf "$to.part/$name.tar.gz" -C "$to.part"
    mv "$to.part/$name" "$to"
    rm -rf "$to.part"
  fi
  "$to/bin/liecheck" --version
}

run_test() {
  [ $# -ge 3 ] || fail "test: expected TO PAGE ADAPTER"
  to=$1 page=$2
  shift 2
  mkdir -p "$page"
  code=0
  "$to/bin/liecheck" test "$@" --page "$page" --badge "$page/badge.svg" >"$page/verdict.txt" 2>&1 || code=$?
  echo $code >"$page/exit_code"
  cat "$page/verdict.txt"
}

code_of() {
  [ -s "$1/exit_code" ] || fail "$1/exit_code is missing: run the step test first"
  cat "$1/exit_code"
}

comment() {
  case $(code_of "$1") in
    0) echo "**liecheck: pass**" ;;
    1) echo "**liecheck: fail**" ;;
    2) echo "**liecheck could not test the library**" ;;
    *) echo "**liecheck: incomplete**" ;;
  esac
  printf '\n```text\n'
  head -c 50000 "$1/verdict.txt" | sed 's/```/` ` `/g'
  printf '```\n'
}

case $step in
  get) get "$@" ;;
  test) run_test "$@" ;;
  comment) comment "$1" ;;
  verdict) exit "$(code_of "$1")" ;;
  *) fail "unknown step '$step': expected get, test, comment or verdict" ;;
esac
