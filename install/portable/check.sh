#!/bin/sh
# check.sh PROGRAM: fails unless the program runs with glibc 2.31 and needs no other library.
set -eu
newer=$(objdump -T "$1" | sed -n 's/.*(GLIBC_\([0-9.]*\)).* \([^ ]*\)$/\1 \2/p' | awk -F'[. ]' '$1 > 2 || $2 > 31' | head)
needed=$(objdump -p "$1" | sed -n 's/^ *NEEDED *//p' | grep -vxE 'lib(c|dl|m|pthread)\.so\.[0-9]|ld-linux-x86-64\.so\.2' || true)
[ -n "$newer$needed" ] || exit 0
echo "$1 needs more than glibc 2.31:" $needed $newer "(glibc_2_31.c replaces what is newer)"
exit 1
