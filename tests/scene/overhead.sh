#!/bin/sh
# overhead.sh PROGRAM URDF counts instructions per step with valgrind. It fails if a scene's run of a lone
# body or a quadruped takes over 2 % more instructions than a hand-written loop, or gives other bits. It also
# fails if LoneBody takes over 0.11 of what Tree takes for the same body (gcc 12: 2,746 and 26,865 instructions).
# Exit code 77: no valgrind.
command -v valgrind > /dev/null || { echo "valgrind is missing"; exit 77; }
PROGRAM=$1 URDF=$2 status=0
count() {  # arguments: way robot steps
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$PROGRAM" "$1" "$2" "$3" "$URDF" 2>&1 > /dev/null |
    sed -n 's/.*Collected : //p'
}
thousand_steps() {  # arguments: way robot
  echo $(($(count "$1" "$2" 1200) - $(count "$1" "$2" 200)))
}
compare() {  # arguments: robot, way 1, its instructions, way 2, its instructions, largest ratio 1/2
  awk -v r="$1" -v x="$2" -v a="$3" -v y="$4" -v b="$5" -v limit="$6" \
    'BEGIN { printf "%s: %.1f instructions per step by %s, %.1f by %s: ratio %.4f\n", r, a / 1000, x, b / 1000, y, a / b
             exit !(a > 0 && a <= limit * b) }' || status=1
}
for robot in lone quadruped; do
  [ "$("$PROGRAM" minimal $robot 1000 "$URDF")" = "$("$PROGRAM" scene $robot 1000 "$URDF")" ] ||
    { echo "$robot: the bits differ"; status=1; }
  scene=$(thousand_steps scene $robot)
  compare $robot "a scene" "$scene" "the loop by hand" "$(thousand_steps minimal $robot)" 1.02
  [ $robot = quadruped ] || compare $robot LoneBody "$scene" Tree "$(thousand_steps tree $robot)" 0.11
done
exit $status
