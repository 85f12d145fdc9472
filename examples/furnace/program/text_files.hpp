// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hearth::furnace::program {

/// Makes a folder where there is none, and returns it.  Throws io::file_error.
const std::filesystem::path& make_folder(const std::filesystem::path& folder);

/// Writes beside and renames, so that a full disk or a kill leaves no half of a file.  Throws io::file_error.
void write_text(const std::filesystem::path& path, const std::string& text);

/// As short as reads back to the same number; JSON has no NaN.
std::string number(double value);
/// As JSON wants it.
std::string quoted(const std::string& text);

/// A table with a title per column; columns without values are left out, a NaN is an empty field.
struct csv {
    std::vector<std::pair<std::string, const std::vector<double>*>> columns;
    std::string text() const;
};

}  // namespace hearth::furnace::program
