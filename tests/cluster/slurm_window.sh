#!/usr/bin/env bash
# The window's page of several machines with a real Slurm, started here.   slurm_window.sh UI_TESTS ROOT
. "$(dirname "$0")/../cli/common.sh"
. "$(dirname "$0")/slurm_here.sh"
slurm_begin || exit $?
trap 'slurm_end; rm -rf "$folder"' EXIT
export QT_QPA_PLATFORM=offscreen UCHILSIM_TEST_SLURM=1 TMPDIR=$folder
expect 0 "a job from the window" "$btr" test_machines elementsInSlurmsQueueAreDoneAndCollected
says out "0 failed, 0 skipped"
finish
