#!/bin/sh
# overhead.sh PROGRAM URDF FOOT,... counts instructions per step with valgrind. It fails
# - if a scene's run takes more instructions than `limit` times a loop written by hand for it, or gives other bits.
#   It is 1.02. Two trees with forces are above it (gcc 12: 1.0200 and 1.040), so that their limits only keep what is
#   reached: a scene keeps the state before a step, from which it locates an event, where the loop only notices it,
#   has a function for each force, where the loop has one for all, and its contact knows other shapes than points;
# - if the free body takes over 0.11 of what the equations of articulated bodies take for it;
# - if the run with the estimate of its error takes over 1.5 times as many;
# - if what `liecheck scene explain` counts differs by more than 5 % from valgrind's count, whose processor chooses
#   other variants of libm and memcpy.
# Exit code 77: no valgrind. Without LIECHECK_NIGHTLY=1 it leaves out some scenes, and what explain counts of trees: where
# the processor does not count instructions for it, that takes 25 s a scene.
command -v valgrind > /dev/null || { echo "valgrind is missing"; exit 77; }
PROGRAM=$1 URDF=$2 FEET=$3 status=0
count() {  # arguments: way scene steps
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$PROGRAM" "$1" "$2" "$3" "$URDF" "$FEET" 2>&1 > /dev/null |
    sed -n 's/.*Collected : //p'
}
step() {  # arguments: way scene, and the steps of two runs
  echo $((($(count "$1" "$2" "$4") - $(count "$1" "$2" "$3")) / ($4 - $3)))
}
compare() {  # arguments: scene, way 1, its instructions, way 2, its instructions, limits of the ratio 1/2
  awk -v r="$1" -v x="$2" -v a="$3" -v y="$4" -v b="$5" -v least="$6" -v most="$7" \
    'BEGIN { printf "%s: %d instructions per step by %s, %d by %s: ratio %.4f\n", r, a, x, b, y, a / b
             exit !(a > 0 && a >= least * b && a <= most * b) }' || status=1
}
explained() {  # arguments: scene, valgrind's count
  counted=$("$PROGRAM" counted "$1" 100 "$URDF" "$FEET")
  if [ "$counted" = 0 ]; then
    echo "$1: this machine does not count instructions"
  else
    compare "$1" explain "$counted" valgrind "$2" 0.95 1.05
  fi
}
scenes="free floating standing" more="pushed"
[ "$LIECHECK_NIGHTLY" = 1 ] && scenes="free dragged floating arm standing" more="pushed offset bouncing pendulum spring top"
for scene in $scenes; do
  [ "$("$PROGRAM" hand $scene 300 "$URDF" "$FEET")" = "$("$PROGRAM" scene $scene 300 "$URDF" "$FEET")" ] ||
    { echo "$scene: the bits differ"; status=1; }
  case $scene in arm) limit=1.025 ;; standing) limit=1.045 ;; *) limit=1.02 ;; esac
  steps=$(step scene $scene 100 400)
  compare $scene "a scene" "$steps" "the loop by hand" "$(step hand $scene 100 400)" 0 $limit
  [ "$LIECHECK_NIGHTLY" != 1 ] && [ $scene != free ] || explained $scene "$steps"
done
compare free "a scene" "$(step scene free 100 400)" Tree "$(step tree free 100 400)" 0 0.11
for scene in $more; do
  explained $scene "$(step scene $scene 100 400)"
done
compare free "a run with its estimate" "$(step estimated free 20000 80000)" "a run without" "$(step scene free 100 400)" 0 1.5
exit $status
