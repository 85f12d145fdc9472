// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace bench {

/// One table of a validation page: its name and what writes it, a line of words, then rows.
using tables = std::vector<std::pair<std::string, std::function<void(std::ostream&)>>>;

/// main of a program `FOLDER [TABLE ...]`: writes all tables, or those named, to FOLDER/TABLE.txt.
inline int write_tables(int count, char** words, const tables& all) {
    if (count < 2) {
        std::cerr << "use: " << words[0] << " FOLDER [TABLE ...]\n";
        return 2;
    }
    const std::vector<std::string> wanted(words + 2, words + count);
    for (const auto& [name, make] : all) {
        if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), name) == wanted.end()) continue;
        std::ofstream file(std::string(words[1]) + "/" + name + ".txt");
        file.precision(6);
        make(file);
        if (!file) {
            std::cerr << "cannot write " << name << ".txt into " << words[1] << '\n';
            return 1;
        }
    }
    return 0;
}

inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace bench
