#!/bin/sh
# Runs a command. An argument `sample:SMALL:FULL` is SMALL, or FULL with LIECHECK_NIGHTLY=1, as in sample.hpp.
for argument; do
  shift
  case $argument in
    sample:*)
      argument=${argument#sample:}
      if [ "$LIECHECK_NIGHTLY" = 1 ]; then argument=${argument#*:}; else argument=${argument%%:*}; fi ;;
  esac
  set -- "$@" "$argument"
done
exec "$@"
