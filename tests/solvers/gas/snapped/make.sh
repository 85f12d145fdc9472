#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes a mesh of snappyHexMesh in WORK: a box around a tube that cells were cut and snapped to, and a ball of finer ones.
#     make.sh WORK
set -euo pipefail
export WM_PROJECT_DIR=/usr/share/openfoam
rm -rf "$1"
mkdir -p "$1"
cp -r "$(dirname "$0")/system" "$1"
cd "$1"
for program in blockMesh "snappyHexMesh -overwrite" checkMesh; do
    $program >log 2>&1 || { tail -n 40 log; exit 1; }
done
