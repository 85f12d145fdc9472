// SPDX-License-Identifier: MIT
#include "checkpoints.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <utility>
#include <vector>

#include <hearth/io/hdf5_file.hpp>

#include "provenance.hpp"

namespace hearth::furnace::program {
namespace {

namespace fs = std::filesystem;

constexpr const char* format_name = "hearth furnace checkpoint 3";

/// The number in checkpoint_NUMBER.h5; -1 for other files.
long number_of(const fs::path& file) {
    long number = -1;
    int read = 0;
    const std::string name = file.filename().string();
    if (std::sscanf(name.c_str(), "checkpoint_%ld.h5%n", &number, &read) != 1) return -1;
    return static_cast<std::size_t>(read) == name.size() ? number : -1;
}

/// Those of a folder, latest first.
std::vector<std::pair<long, fs::path>> checkpoints_in(const fs::path& folder) {
    std::vector<std::pair<long, fs::path>> found;
    if (fs::is_directory(folder)) {
        for (const auto& entry : fs::directory_iterator(folder)) {
            if (const long number = number_of(entry.path()); number >= 0) found.emplace_back(number, entry.path());
        }
    }
    std::sort(found.rbegin(), found.rend());
    return found;
}

/// "mesh.cells_across = 24, in the scene: 40; ..." of two scenes as `document` writes them.
std::string differences(const std::string& saved, const std::string& asked) {
    std::istringstream first(saved), second(asked);
    std::string one, other, table, list;
    const auto bare = [](const std::string& line) { return line.substr(0, line.find("  #")); };
    while (std::getline(first, one) && std::getline(second, other)) {
        if (!one.empty() && one[0] == '[') table = one.substr(1, one.find(']') - 1) + ".";
        if (bare(one) == bare(other)) continue;
        const std::size_t value = bare(other).find("= ");
        list += (list.empty() ? "" : "; ") + table + bare(one) + ", in the scene: " +
                (value == std::string::npos ? bare(other) : bare(other).substr(value + 2));
    }
    return list.empty() ? "they have another number of wall zones or particle sizes" : list;
}

saved_state read_file(const fs::path& path, const settings& scene) {
    const io::hdf5_file file(path.string(), io::hdf5_file::mode::read_checksummed);
    const auto refuse = [&](const std::string& what) { throw io::file_error(path.string() + ": " + what); };
    if (!file.has("/furnace")) refuse("is no checkpoint of a furnace");
    if (file.read_text_attribute("/furnace", "format") != format_name) {
        refuse("is \"" + file.read_text_attribute("/furnace", "format") + "\", expected: \"" + format_name + "\"");
    }
    const std::string saved = file.read_text_attribute("/furnace", "scene"), asked = document(scene);
    if (saved != asked) throw bad_scene(path.string() + ": is of another scene: " + differences(saved, asked));
    saved_state state;
    std::istringstream names(file.read_text_attribute("/furnace", "arrays"));
    for (std::string name; std::getline(names, name);) state[name] = file.read_all<double>("state/" + name);
    return state;
}

}  // namespace

checkpoints::checkpoints(fs::path folder, ranks among) : folder_(std::move(folder)), among_(std::move(among)) {}

fs::path checkpoints::write(const saved_state& state, const settings& scene) {
    std::vector<std::pair<long, fs::path>> before;
    if (among_.rank() == 0) before = checkpoints_in(folder_);  // what others see of the folder may be late
    const std::int64_t number = among_.max(std::int64_t{before.empty() ? 1 : before.front().first + 1});
    char name[40];
    std::snprintf(name, sizeof name, "checkpoint_%04ld.h5", static_cast<long>(number));
    const fs::path path = folder_ / name;
    io::hdf5_file file(path.string(), io::hdf5_file::mode::write_checksummed);
    file.write_attribute("/furnace", "format", std::string(format_name));
    file.write_attribute("/furnace", "version", version());
    file.write_attribute("/furnace", "scene", document(scene));
    std::string names;
    for (const auto& [array, values] : state) {
        file.write("state/" + array, values);
        names += array + '\n';
    }
    file.write_attribute("/furnace", "arrays", names);
    file.close();
    std::error_code ignored;  // what cannot be removed does no harm
    for (std::size_t k = 1; k < before.size(); ++k) fs::remove(before[k].second, ignored);
    return path;
}

saved_state read_checkpoint(const fs::path& place, const settings& scene, std::string& remark) {
    remark.clear();
    if (!fs::is_directory(place)) return read_file(place, scene);
    const auto found = checkpoints_in(place);
    if (found.empty()) throw io::file_error(place.string() + ": holds no checkpoint");
    for (std::size_t k = 0; k + 1 < found.size(); ++k) {
        try {
            return read_file(found[k].second, scene);
        } catch (const io::file_error& error) {
            remark += std::string(error.what()) + "; the one before it serves\n";
        }
    }
    return read_file(found.back().second, scene);
}

}  // namespace hearth::furnace::program
