#!/usr/bin/env bash
# Runs the tests of a sanitized build, but for what takes longest there: of whole analyses one, of whole runs those that
# stop and go on.
#   bash tests/sanitized.sh FOLDER "PART…" ["WINDOW TEST…"]
set -euo pipefail
export bin=$1 parts=$2 windows=${3:-}
export logs=$(mktemp -d)
trap 'rm -rf "$logs"' EXIT
# libode, libsqlite, Qt and OpenSceneGraph are not ours: their one-time allocations are not leaks of this program.
export ASAN_OPTIONS=detect_leaks=0
long="Xl330*:StrangeCarriage*:StrangeFan*:StrangePendulum*:Screener.Promises*:ShownSizes.FrictionThatGrows*:IndependentBall*:MeasuredLaw*:DisagreeingTrials*:StrangeServo*:StrangeArm.ThatAnother*:StrangeArm.Friction*:StrangeArm.Dry*:StrangeArm.ADelay*:ModelComparison.DryFriction*:ModelComparison.WhereDry*:WithItsLoop*:JointSpace.Driven*:JointSpace.TheStep*:JointSpace.ASwinging*:Locate.*:NextRecording.PushesAJoint*:TossedBody.WhatThe*:Consultation.LeadsTheReport*:Residual*:Analysis*:JobFailures.AnEffect*:JobFailures.NoVerdict*:TorqueNoise.ThatHides*:Fit.*:JointDoctor*:All/EffectTrials*:KickTrial*:KickReach*:Dog.LeftAndRight*:WalkTrial.WalksWhere*:WalkTrial.TheStart*:WorldDeskTest.AMillion*"
analysis="Analysis.ASensorThatIsOffFromTheFirstSampleOnIsExplainedDownToTheNoise"
resume="KilledRun.StopsCleanlyOnInterruptAndGoesOn:PreparedExperiment.*"

sanitized_part() {  # program, filter, part, of how many: every so-manieth test
  local log=$logs/$BASHPID began=$SECONDS
  GTEST_SHARD_INDEX=$3 GTEST_TOTAL_SHARDS=$4 timeout 1200 "$bin/$1" --gtest_brief=1 "--gtest_filter=$2" > "$log" 2>&1 ||
    { cat "$log"; echo "FAILED, or not over after 20 minutes: $1"; return 1; }
  echo "$1 part $3: $(tail -n 1 "$log") in $((SECONDS - began)) s"
}
sanitized_window() {
  local log=$logs/$BASHPID began=$SECONDS
  XDG_RUNTIME_DIR=/tmp timeout 1200 "$bin/ui_tests" "$1" > "$log" 2>&1 || { cat "$log"; echo "FAILED: $1"; return 1; }
  echo "$1: $(grep '^Totals' "$log") in $((SECONDS - began)) s"
}
sanitized() { if [ $# = 1 ]; then sanitized_window "$@"; else sanitized_part "$@"; fi; }
export -f sanitized sanitized_part sanitized_window
{
  echo "test_gap $analysis 0 1"
  # Longer than all others together: in parts that are not much longer than these.
  for part in {0..7}; do echo "test_gap -$long $part 8"; done
  echo "test_runs $resume 0 1"
  for name in $parts; do
    case $name in
      gap | runs) ;;
      live) for part in 0 1; do echo "test_live -$long $part 2"; done ;;
      *) echo "test_$name -$long 0 1" ;;
    esac
  done
  printf '%s\n' $windows
} | xargs -P "$(nproc)" -L 1 bash -c 'sanitized "$@"' _
