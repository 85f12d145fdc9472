// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <hearth/furnace/furnace.hpp>

namespace hearth::furnace::program {

/// What the pictures show, as JSON: the cells and particles that the plane y = 0 and the plane of the hottest particles cut,
/// in the shape of the cut.
std::string picture_data(const furnace& shaft, const snapshot& seen);

/// picture.py, which draws picture.json and the CSV files beside it; every folder of results has its own, to be changed.
std::string picture_script();

/// Draws the pictures of a folder of results; false, with the reason, where Python or matplotlib is not there.
bool draw(const std::string& folder, std::string& reason);

}  // namespace hearth::furnace::program
