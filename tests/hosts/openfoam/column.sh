#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A packed column in OpenFOAM's rhoPimpleFoam with hearth's bed as a source, on one rank and on two.
#     column.sh CASE WORK FOLDER_OF_libhearthPackedBed.so column "MPIEXEC AND FLAGS"
set -euo pipefail
case=$1 work=$2 check=$4 mpiexec=$5
export WM_PROJECT_DIR=/usr/share/openfoam OMPI_MCA_mpi_yield_when_idle=1 LD_LIBRARY_PATH=$3${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
rm -rf "$work"
mkdir -p "$work"
cp -r "$case"/. "$work"
cd "$work"
run() {
    echo "+ $*"
    "$@" >log 2>&1 || { tail -n 40 log; exit 1; }
}
awk 'BEGIN {
    for (k = 0; k < 30; ++k) for (j = 0; j < 3; ++j) for (i = 0; i < 3; ++i)
        printf "%.17g %.17g %.17g 0.005\n", (i + 0.5) / 100, (j + 0.5) / 100, (k + 0.5) / 100
}' >bed.csv
pressures() {  # of the cells along the column
    awk '/^\(/ { on = 1; next } /^\)/ { exit } on { printf "%.6g %s\n", (n++ + 0.5) / 200, $1 }' 2/p >pressures
}
energy() {  # what the bed took and the gas gave
    tail -n 200 log | grep '^hearth: bed took' | tail -n 1 | tee ledger
    awk '{ exit !($4 > 70 && $11 < 1e-12 * $4) }' <(tr -d , <ledger)
}

run blockMesh
run rhoPimpleFoam
energy
pressures
"$check" pressures 2/hearthParticles
mv 2 serial

run decomposePar
run $mpiexec rhoPimpleFoam -parallel
energy
run reconstructPar -withZero -latestTime
pressures
"$check" pressures processor*/2/hearthParticles
