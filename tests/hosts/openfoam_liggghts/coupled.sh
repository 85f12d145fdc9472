#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# An OpenFOAM solver and LIGGGHTS in one job, on one rank and on two: what one gets the other loses, to 1e-12.
#     coupled.sh CASE WORK hearthFoam CHECK "MPIEXEC AND FLAGS"
set -euo pipefail
case=$1 work=$2 solver=$3 check=$4 mpiexec=$5
export WM_PROJECT_DIR=/usr/share/openfoam OMPI_MCA_mpi_yield_when_idle=1  # there may be fewer cores than ranks
rm -rf "$work"
mkdir -p "$work"
cd "$work"
run() {
    echo "+ $*"
    "$@" >log 2>&1 || { tail -n 40 log; exit 1; }
}
solve() {  # FOLDER RANKS SPHERES EDIT...
    local name=$1 all_ranks=$2 spheres=$3 ranks edit
    shift 3
    for ranks in $all_ranks; do
        cp -r "$case" "$name$ranks"
        pushd "$name$ranks" >/dev/null
        for edit in "$@"; do sed -i -E "$edit" constant/coupling system/controlDict; done
        run blockMesh
        if [ $ranks = 1 ]; then
            run "$solver"
        else
            run decomposePar
            run $mpiexec "$solver" -parallel
        fi
        grep '^hearth: off by' log | tail -n 1 | tee ledger
        # drag, pressure, heat; and walls, where the spheres touch none
        awk -v touching="$(grep -c insert/pack in.*)" '
            { exit !(NF == 12 && $5 < 1e-12 && $7 < 1e-12 && $9 < 1e-12 && (touching || $12 < 1e-12)) }' <(tr -d ';' <ledger)
        test "$(cat $spheres 2>/dev/null | wc -l)" -gt 200
        popd >/dev/null
    done
}

case $case in
*/settling)
    solve settling "1 2" "0.1/spheres processor*/0.1/spheres"
    "$check" settling1/0.1/spheres
    "$check" settling2/processor?/0.1/spheres
    # The same spheres: all numbers to what the solver of the pressure leaves.
    paste <(sort -n settling1/0.1/spheres) <(sort -n settling2/processor?/0.1/spheres) | awk '
        { for (k = 1; k <= 6; ++k) { d = $k - $(k + 6); if (d < 0) d = -d; s = $k < 0 ? -$k : $k; if (d > 1e-9 * (s + 1e-3)) exit 1 } }'
    ;;
*/bed)
    solve split "1 2" "2/spheres processor*/2/spheres"
    solve plain 1 400/spheres 's/acceleration 200/atRest true; acceleration 1/' 's/^endTime .*/endTime 400;/' 's/^deltaT .*/deltaT 1;/'
    solve paper 1 2/spheres 's/acceleration/atRest true; paperStorage true; acceleration/'
    "$check" split1 plain1 0.005  # the same equations; the gas's own inertia is not split
    "$check" split2 plain1 0.03   # two ranks pour another packing
    "$check" paper1 plain1 0.08   # the paper finds 8 % with the gas storage as it is
    ;;
esac
