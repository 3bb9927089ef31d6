#!/bin/sh
# overhead.sh PROGRAM URDF: instructions a step of a scene's run over those of the loop written by hand, for the lone
# body and for a quadruped, counted by valgrind. Fails above 2 % or where a bit differs. Exit 77: no valgrind.
command -v valgrind > /dev/null || { echo "valgrind is missing"; exit 77; }
count() {  # what robot steps
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$PROGRAM" "$1" "$2" "$3" "$URDF" 2>&1 > /dev/null |
    sed -n 's/.*Collected : //p'
}
PROGRAM=$1 URDF=$2 status=0
for robot in lone quadruped; do
  [ "$("$PROGRAM" minimal $robot 1000 "$URDF")" = "$("$PROGRAM" scene $robot 1000 "$URDF")" ] ||
    { echo "$robot: the bits differ"; status=1; }
  few=200 many=1200
  least=$((($(count minimal $robot $many) - $(count minimal $robot $few))))
  ours=$((($(count scene $robot $many) - $(count scene $robot $few))))
  awk -v r=$robot -v a=$least -v b=$ours -v n=$((many - few)) \
    'BEGIN { printf "%s: %.1f instructions a step by hand, %.1f by the scene: %+.2f %%\n", r, a / n, b / n, 100 * (b - a) / a
             exit b > 1.02 * a }' || status=1
done
exit $status
