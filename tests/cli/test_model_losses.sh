#!/usr/bin/env bash
# What a robot loses of its file is said wherever it is simulated, not only by btr model check.
. "$(dirname "$0")/common.sh"
mkdir -p "$folder/urdf"
cat > "$folder/urdf/arm.urdf" <<'XML'
<robot name="arm">
  <link name="stand"/>
  <link name="arm">
    <inertial><origin xyz="0 0 -0.1"/><mass value="0.2"/><inertia ixx="0.001" iyy="0.001" izz="0.001"/></inertial>
    <collision><geometry><mesh filename="package://arm/meshes/arm.stl"/></geometry></collision>
  </link>
  <joint name="hinge" type="revolute"><parent link="stand"/><child link="arm"/><axis xyz="0 1 0"/>
    <limit effort="0" velocity="5"/></joint>
</robot>
XML
scene() {  # more keys of the robot
  echo '{"format": "uchilsim-scene-1", "robots": [{"name": "a", "model": "urdf/arm.urdf", "base": "fixed"'"$1"'}]}' > "$folder/scene.json"
}
python3 -c '
import math
print("time_s,a.hinge.command_rad,a.hinge.position_rad")
for i in range(101): print(f"{i / 100:.2f},0.2,{0.2 + 0.01 * math.sin(i):.5f}")' > "$folder/trial.csv"
scene ""
collides="line 5): link arm: mesh \"package://arm/meshes/arm.stl\": there is no such file"
limits="line 8): joint hinge: lower and upper are left out"
effort="line 8): joint hinge: effort 0 is taken as not given: its servo gets 0.85 N m"
all() { for text in "$collides" "$limits" "$effort"; do says out "$text"; done; }
expect 0 "model check" "$btr" model check "$folder/urdf/arm.urdf"
says out "there is no such file"
expect 0 "residual" "$btr" gap residual "$folder/scene.json" --recording "$folder/trial.csv"
all
expect 0 "predict" "$btr" gap predict "$folder/scene.json" --recording "$folder/trial.csv" --out "$folder/predicted.csv"
all
expect 0 "analyse" "$btr" gap analyse "$folder/scene.json" --recording "$folder/trial.csv" --effects viscous_friction --out "$folder/report"
says out "The robot is not simulated as its file says: a (urdf/arm.urdf, $collides"
python3 - "$folder/report/report.json" "$collides" "$limits" "$effort" <<'PY' || fail "the report's notes"
import json, sys
notes = json.load(open(sys.argv[1]))["notes"]
for i, text in enumerate(sys.argv[2:]):
    assert text in notes[i], notes
PY

# What the scene makes good is not said.
scene ', "collision": "none", "servos": {"hinge": {"drive": "servo", "max_torque_nm": 1}}'
expect 0 "residual without collisions" "$btr" gap residual "$folder/scene.json" --recording "$folder/trial.csv"
says out "$limits"
for text in "$collides" "$effort"; do grep -qF -- "$text" "$folder/out" && fail "said without need: $text"; done
finish
