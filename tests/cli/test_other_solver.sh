#!/usr/bin/env bash
# Where libode does not call our constraint solver, trials would differ from other machines in silence: refused instead.
. "$(dirname "$0")/common.sh"
libode=$(ldd "$(dirname "$btr")/../lib/libbtr_core.so" 2> /dev/null | awk '/libode/ {print $3}')
[ -n "$libode" ] || libode=$(ldd "$btr" | awk '/libode/ {print $3}')
[ -n "$libode" ] || { fail "no libode found"; finish; }
expect 1 "a run with a preloaded libode" env LD_PRELOAD="$libode" "$btr" run "$root/resources/experiments/kick-short.json" --db "$folder/a.db"
one_line
says err "this libode"
printf 'time_s,leg.x.command_rad,leg.x.position_rad\n0,0,0\n0.01,0,0\n' > "$folder/trial.csv"
expect 1 "a residual" env LD_PRELOAD="$libode" "$btr" gap residual "$root/resources/scenes/kick.json" --recording "$folder/trial.csv"
says err "this libode"
expect 0 "a list" env LD_PRELOAD="$libode" "$btr" list effects
finish
