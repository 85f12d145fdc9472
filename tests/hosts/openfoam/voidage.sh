#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The solid fraction in an OpenFOAM case is the same on one rank and on two, to 1e-13 of each cell's volume.
#     voidage.sh CASE WORK hearthVoidFraction conformance "MPIEXEC AND FLAGS"
set -euo pipefail
case=$1 work=$2 utility=$3 conformance=$4 mpiexec=$5
export WM_PROJECT_DIR=/usr/share/openfoam OMPI_MCA_mpi_yield_when_idle=1
rm -rf "$work"
mkdir -p "$work"
cp -r "$case"/. "$work"
cd "$work"
find . -name '*.gz' -exec gunzip {} +
sed -i 's/numberOfSubdomains.*/numberOfSubdomains 2;/; s/(1 6 1)/(1 2 1)/' system/decomposeParDict  # a tutorial's
run() {
    echo "+ $*"
    "$@" >log 2>&1 || { tail -n 40 log; exit 1; }
    grep -E '^(solidFraction|smoother|\[[01]\] [0-9]+ checks|[0-9]+ checks|largest|.*differ)' log || true
}

run blockMesh
if [ -e system/snappyHexMeshDict ]; then
    run snappyHexMesh -overwrite
    # The case is about hanging refinement, so there must be some: coarse cells with more than six faces.
    run checkMesh
    grep -E 'polyhedra: *[1-9]' <(sed -n 1,200p log) || { echo "no hanging refinement in this mesh"; exit 1; }
fi

# Spheres of 3 to 6 mm, larger and smaller than cells, packed to 0.4 and sticking out of the sides of the box; none in the
# tube of the refined case, of 12 mm about the middle up to 30 mm.
awk -v nx="${6:-13}" -v ny="${7:-13}" -v x0="${8:-0.002}" -v y0="${9:-0.002}" -v tube="$([ -e system/snappyHexMeshDict ] && echo 0.014)" 'BEGIN {
    for (k = 0; k < 10; ++k) for (j = 0; j < ny; ++j) for (i = 0; i < nx; ++i) {
        x = x0 + 0.0062 * i + 0.0007 * sin(3 * i + k)
        y = y0 + 0.0062 * j + 0.0007 * sin(5 * j + i)
        z = 0.002 + 0.0062 * k + 0.0007 * sin(7 * k + j)
        if (z < 0.032 && (x - 0.04)^2 + (y - 0.04)^2 < tube^2) continue
        printf "%.17g %.17g %.17g %.17g\n", x, y, z, 0.00225 + 0.00075 * sin(i + 2 * j + 3 * k)
    }
}' >bed.csv

run "$conformance"
run "$utility" -particles bed.csv
run decomposePar -time 0
run $mpiexec "$conformance" -parallel
run $mpiexec "$utility" -particles "$PWD/bed.csv" -compare -parallel
grep -q '^largest difference' log
