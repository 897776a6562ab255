#!/usr/bin/env bash
# From sources to a stick, a first run, and what is said when it cannot be done.
. "$(dirname "$0")/common.sh"

programs=$root/tests/openr/programs
expect 0 "two programs on one stick" "$btr" openr build "$programs/names" "$programs/faulty" --out "$folder/MS"
says out "NAMES.BIN  from"
says out "FAULTY.BIN  from"
expect 0 "a first run" "$btr" openr try --stick "$folder/MS" --seconds 0.2
says out "Names: size 1 3 10.0.1.100"
expect 0 "the same again" "$btr" openr try --stick "$folder/MS" --seconds 0.2
cp "$folder/out" "$folder/first"
expect 0 "the same again" "$btr" openr try --stick "$folder/MS" --seconds 0.2
cmp -s "$folder/first" "$folder/out" || fail "two runs differ"
expect 1 "a crash" "$btr" openr try --stick "$folder/MS" --seconds 1 --type 'null\n'
says err "Faulty crashed in Notify: it wrote at address 0"

mkdir -p "$folder/wrong/Thing" "$folder/empty"
cat > "$folder/wrong/Thing/stub.cfg" <<'CFG'
ObjectName : Thing
NumOfOSubject : 1
NumOfOObserver : 2
Service : "Thing.A.B.S", null, null
Service : "Thing.A.B.O", null, null
CFG
expect 1 "a wrong stub.cfg" "$btr" openr build "$folder/wrong" --out "$folder/out_ms"
says err "NumOfOObserver: 2 is not allowed; 1 is"
sed -i 's/NumOfOObserver : 2/NumOfOObserver : 1/' "$folder/wrong/Thing/stub.cfg"
echo 'class Thing { this is no C++ };' > "$folder/wrong/Thing/Thing.h"
expect 1 "wrong sources" "$btr" openr build "$folder/wrong" --out "$folder/out_ms"
says err "Thing.h:1:"
says err "not built; mend what the compiler says above"

# What is mended is not complained about.
cp -r "$programs/names" "$folder/mistaken"
cat > "$folder/mistaken/Names/old.cc" <<'CC'
int old() {
  for (int i = 0; i < 5; i++) if (i == 3) break;
  int least = i <? 4;
  return least + mistaken;
}
CC
expect 1 "one mistake among what is mended" "$btr" openr build "$folder/mistaken" --out "$folder/out_ms"
says err "old.cc:4:18: error: 'mistaken' was not declared"
[ "$(grep -c error: "$folder/err")" = 1 ] || fail "errors of what is mended: $(grep error: "$folder/err")"
rm "$folder/mistaken/Names/old.cc"
printf '# settings\nobject Names 3072 16384 128 cache tlb user\nfoo bar\n' > "$folder/mistaken/Names/Names.ocf"
expect 1 "a line that no .ocf has" "$btr" openr build "$folder/mistaken" --out "$folder/out_ms"
says err 'Names.ocf:3: "foo bar" is not allowed; object NAME STACK HEAP PRIORITY cache tlb user'
sed -i /foo/d "$folder/mistaken/Names/Names.ocf"
expect 0 "comments in an .ocf" "$btr" openr build "$folder/mistaken" --out "$folder/out_ms"
expect 1 "nothing to build" "$btr" openr build "$folder/empty" --out "$folder/out_ms"
says err "has no OPEN-R object"
expect 1 "no list" "$btr" openr try --stick "$folder/empty"
says err "OBJECT.CFG is missing"
cp -r "$folder/MS" "$folder/broken"
for module in "$folder"/broken/OPEN-R/MW/OBJS/*; do echo "no module" > "$module"; done
expect 1 "no object starts" "$btr" openr try --stick "$folder/broken" --seconds 1
says err "no object could be started: /MS/OPEN-R/MW/OBJS/NAMES.BIN is no module that"
expect 1 "no object starts in a game" "$btr" openr run --game "$root/resources/robots/ers7.wrl" --robot robot --stick "$folder/broken" --seconds 0.1
says err "robot's program ended: no object could be started: /MS/OPEN-R/MW/OBJS/NAMES.BIN"
expect 1 "no such robot" "$btr" openr try --stick "$folder/MS" --design ERS-8
says err "ERS-7, ERS-210 or ERS-220"
finish
