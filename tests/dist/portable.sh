#!/bin/sh
# portable.sh PROGRAM ORDINARY SOURCE BAD_CITIZENS ROTATIONS: the program that is shipped runs with glibc 2.31 and no other
# library, as the ordinary one does not, and what glibc_2_31.c replaces works: threads, exceptions, signals, files, libraries.
set -eu
program=$1 ordinary=$2 source=$3 bad=$4 rotations=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
  echo "portable.sh: $*"
  exit 1
}
expect() {  # CODE WORDS COMMAND...
  code=$1 words=$2 is=0
  shift 2
  "$@" >"$work/said" 2>&1 || is=$?
  [ $is = "$code" ] && grep -qe "$words" "$work/said" || fail "$*: exit code $is, and not $code with '$words': $(head -c 2000 "$work/said")"
}

sh "$source/install/portable/check.sh" "$program"
if sh "$source/install/portable/check.sh" "$ordinary" >"$work/said"; then fail "$ordinary needs no more"; fi
grep -q "libstdc++.*2[.]34 dlopen" "$work/said" || fail "$(cat "$work/said")"

cd "$work"
expect 0 "^rules [0-9]" "$program" --version
expect 0 "^verdict pass" "$program" test "$rotations" --cases 500 -j 2 --page page
[ -s page/report.html ] || fail "no page"
expect 0 "^verdict pass" "$program" campaign --cases 10 -j 2 --store a.db --json a.json
[ -s a.json ] || fail "no record"
digests() {
  "$1" campaign --cases 5 --no-hard-cases --verbose | grep -E '^(inputs|results) '
}
[ "$(digests "$program" | grep -c '[0-9a-f]\{60\}')" = 2 ] || fail "no digests"
[ "$(digests "$program")" = "$(digests "$ordinary")" ] || fail "other results than those of $ordinary"
expect 2 "unknown subject 'nobody'" "$program" campaign --subject nobody
expect 2 "nothing.urdf" "$program" robot nothing.urdf
LIECHECK_BAD=segfault expect 3 "the signal SIGSEGV" "$program" campaign --cases 1000 --adapter "in-process:$bad"
"$program" campaign --cases 100000000 --store b.db >said 2>&1 &
sleep 1
kill -TERM $!
code=0
wait $! || code=$?
[ $code = 3 ] && grep -q "^to resume:" said || fail "SIGTERM: exit code $code: $(cat said)"
