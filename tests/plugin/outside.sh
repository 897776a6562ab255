#!/usr/bin/env bash
# Installs the program into a temporary folder, builds resources/plugin-examples and robot-examples against it as a
# stranger would, and runs them: outside.sh CMAKE BUILD COMPILER TEST_PLUGIN
cmake=$1 build=$2 compiler=$3 test_plugin=$4
. "$(dirname "$0")/../cli/common.sh" "" ""
prefix=$folder/prefix
unset UCHILSIM_PLUGINS UCHILSIM_RESOURCES
if launcher=$(command -v ccache); then
  # The folder has another name each time: without it in the paths what was compiled before is found again.
  export CMAKE_CXX_COMPILER_LAUNCHER=$launcher CCACHE_NOHASHDIR=1 CCACHE_DIR=${CCACHE_DIR:-$(ccache -k cache_dir)} CCACHE_BASEDIR=$folder
fi
export XDG_DATA_HOME=$folder/data HOME=$folder

expect 0 "install" "$cmake" --install "$build" --prefix "$folder/first" --component headless
mv "$folder/first" "$prefix"  # nothing may remember where it was installed
btr=$prefix/bin/btr
expect 0 "the installed program finds its plugins" "$btr" list effects
says out coulomb_friction
grep -q quadratic_drag "$folder/out" && fail "an effect that was not built is listed"
[ -z "$(find "$prefix/include" -path '*core/store*' -o -path '*core/run*' -o -path '*core/gap*')" ] ||
  fail "headers of store, run or gap are installed"

examples=$prefix/share/uchilsim/plugin-examples
expect 0 "configure" "$cmake" -S "$examples" -B "$examples/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler"
expect 0 "build" "$cmake" --build "$examples/build"
[ $failures = 0 ] || { cat "$folder/out"; exit 1; }

export UCHILSIM_PLUGINS=$examples/build/plugins
expect 0 "list effects" "$btr" list effects
says out quadratic_drag
expect 0 "list realities" "$btr" list realities
for name in constant csv_folder person program stand_in; do says out "$name: "; done
expect 0 "list plugins" "$btr" --json list plugins
python3 - "$folder/out" "$examples" <<'PYTHON' || fail "list plugins --json"
import json, sys
document = json.load(open(sys.argv[1]))
assert document["failures"] == [], document["failures"]
found = {(p["kind"], p["name"]): p for p in document["plugins"]}
for kind, name in [("controller", "swing"), ("learner", "random_search"), ("fitness", "ball_way"), ("effect", "quadratic_drag"), ("reality", "constant")]:
    plugin = found[kind, name]
    assert (plugin["version"], plugin["author"], plugin["licence"]) == ("1.0", "UCHILSIM", "GPL-3.0-or-later"), plugin
    assert plugin["path"].startswith(sys.argv[2] + "/build/plugins/"), plugin
PYTHON

# Silent at its neutral values, finite at its bounds: the suite of all effects takes it in.
expect 0 "the tests of all effects" "$test_plugin" --gtest_filter='*eutral*'
unset UCHILSIM_PLUGINS

# The experiment itself names the folder; copied as the manual says, with the scenes beside it.
mkdir "$folder/copied"
cp -r "$prefix"/share/uchilsim/{plugin-examples,scenes,robots} "$folder/copied"
expect 0 "run" "$btr" run "$folder/copied/plugin-examples/experiment.json" --db "$folder/first.db" --jobs 1
expect 0 "export" "$btr" export --db "$folder/first.db" --run 1 --what generations
[ "$(wc -l < "$folder/out")" = 3 ] || fail "not two generations"

# In the user's own folder, it needs no name; twice the same name is refused and both are named.
mkdir -p "$XDG_DATA_HOME/uchilsim"
cp -r "$examples/build/plugins" "$XDG_DATA_HOME/uchilsim/plugins"
expect 0 "the user's folder" "$btr" list effects
says out quadratic_drag
UCHILSIM_PLUGINS=$examples/build/plugins expect 0 "twice the same name" "$btr" list plugins
says out "not loaded: $XDG_DATA_HOME/uchilsim/plugins/effects/quadratic_drag.so: another effect plugin has the same name"
says out "$examples/build/plugins/effects/quadratic_drag.so"
rm -r "$XDG_DATA_HOME/uchilsim"

# Behaviours: as plugins and as programs, with the same bits.
robots=$prefix/share/uchilsim/robot-examples
expect 0 "configure behaviours" "$cmake" -S "$robots" -B "$robots/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler"
expect 0 "build behaviours" "$cmake" --build "$robots/build"
export UCHILSIM_PLUGINS=$robots/build/plugins
expect 0 "a behaviour as a plugin" "$btr" --json live "$robots/wall.json" --seconds 2
plugin=$(grep -o '"trace_sha256": *"[^"]*"' "$folder/out")
"$btr" --json serve --port 0 > "$folder/serve" 2> "$folder/serve.err" &
server=$!
while ! grep -q '"port"' "$folder/serve" && kill -0 $server 2> /dev/null; do read -rt 0.05 < <(:) || true; done
port=$(grep -o '"port": *[0-9]*' "$folder/serve" | grep -o '[0-9]*$')
expect 0 "a behaviour as a program" "$robots/build/programs/stroll" --server "127.0.0.1:$port" --game robot-examples/wall.json \
  --robot red1 --seconds 2 --json
program=$(grep -o '"trace_sha256": *"[^"]*"' "$folder/out")
[ -n "$plugin" ] && [ "$plugin" = "$program" ] || fail "the plugin's $plugin, the program's $program"
kill $server
wait $server
unset UCHILSIM_PLUGINS

sed -i 's|"build/plugins"|"nowhere"|' "$examples/experiment.json"
expect 1 "a folder that is not there" "$btr" run "$examples/experiment.json" --db "$folder/second.db"
says err "$examples/nowhere"
one_line
finish
