// SPDX-License-Identifier: MIT
#include "text_files.hpp"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include <hearth/io/hdf5_file.hpp>

namespace hearth::furnace::program {

namespace fs = std::filesystem;

const fs::path& make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw io::file_error(folder.string() + ": cannot be made: " + error.message());
    return folder;
}

void write_text(const fs::path& path, const std::string& text) {
    const fs::path part = path.string() + ".part";
    std::ofstream file(part, std::ios::binary);
    file << text;
    file.close();
    std::error_code error;
    if (file) fs::rename(part, path, error);
    if (!file || error) {
        const std::string why = error ? error.message() : std::strerror(errno);
        fs::remove(part, error);
        throw io::file_error(path.string() + ": cannot be written: " + why);
    }
}

std::string number(double value) {
    if (!std::isfinite(value)) return "null";
    char text[32];
    for (int digits = 6; digits <= 17; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        if (std::strtod(text, nullptr) == value) break;
    }
    return text;
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        char escaped[8];
        if (c == '"' || c == '\\') {
            out += {'\\', c};
        } else if (static_cast<unsigned char>(c) < 0x20) {
            std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(c));
            out += escaped;
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string csv::text() const {
    std::string out;
    std::vector<const std::vector<double>*> kept;
    for (const auto& [title, values] : columns) {
        if (values->empty()) continue;
        out += (kept.empty() ? "" : ",") + title;
        kept.push_back(values);
    }
    out += '\n';
    for (std::size_t row = 0; !kept.empty() && row < kept.front()->size(); ++row) {
        for (std::size_t k = 0; k < kept.size(); ++k) {
            const double value = (*kept[k])[row];
            out += (k == 0 ? "" : ",") + (std::isfinite(value) ? number(value) : "");
        }
        out += '\n';
    }
    return out;
}

}  // namespace hearth::furnace::program
