// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <hearth/gas/array.hpp>

namespace bench {

/// A case of Debian's OpenFOAM in a folder of its own, which is removed at the end.
class openfoam_case {
  public:
    /// From the template of that name beside this file, with entries for its file `parameters`.
    openfoam_case(const std::string& name, const std::string& parameters) {
        std::string folder = (std::filesystem::temp_directory_path() / "hearth_XXXXXX").string();
        if (!mkdtemp(folder.data())) throw std::runtime_error("cannot make " + folder);
        folder_ = folder;
        const std::filesystem::path templates = HEARTH_OPENFOAM_TEMPLATES;
        std::filesystem::copy(templates / name, folder_, std::filesystem::copy_options::recursive);
        std::filesystem::copy(templates / "mesh", folder_ / "system", std::filesystem::copy_options::recursive);
        std::ofstream(folder_ / "parameters") << parameters;
    }
    openfoam_case(const openfoam_case&) = delete;
    ~openfoam_case() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }

    const std::filesystem::path& folder() const { return folder_; }

    /// Runs one of its programs; throws where it fails, with the end of what it wrote.  Returns its peak memory
    /// [bytes].
    double run(const char* program) {
        const pid_t child = fork();
        if (child == 0) {
            const bool ready = chdir(folder_.c_str()) == 0 && std::freopen("log", "w", stdout) && dup2(1, 2) == 2;
            setenv("WM_PROJECT_DIR", "/usr/share/openfoam", 0);
            if (ready) execlp(program, program, static_cast<char*>(nullptr));
            _exit(127);
        }
        int status = -1;
        rusage used{};
        if (child < 0 || wait4(child, &status, 0, &used) != child || status != 0)
            throw std::runtime_error(std::string(program) + " failed: " + end_of_log());
        return 1024.0 * static_cast<double>(used.ru_maxrss);
    }

    /// The numbers that follow a text in the log of the last program.
    hearth::gas::array<double> after(const std::string& text) const {
        hearth::gas::array<double> values;
        std::ifstream log(folder_ / "log");
        for (std::string line; std::getline(log, line);)
            if (const auto at = line.find(text); at != line.npos)
                values.push_back(std::strtod(&line[at + text.size()], nullptr));
        if (values.empty()) throw std::runtime_error("OpenFOAM wrote no '" + text + "': " + end_of_log());
        return values;
    }

    /// A scalar field that was written in ASCII, cell by cell.
    hearth::gas::array<double> field(const std::string& file) const {
        std::ifstream in(folder_ / file);
        for (std::string word; in >> word && word.rfind("List<scalar>", 0) != 0;) {
        }
        int count = 0;
        char bracket = 0;
        in >> count >> bracket;
        hearth::gas::array<double> values(count);
        for (double& v : values) in >> v;
        if (!in || count == 0) throw std::runtime_error("cannot read " + file);
        return values;
    }

  private:
    std::string end_of_log() const {
        std::ifstream log(folder_ / "log");
        std::string all{std::istreambuf_iterator<char>(log), {}};
        return all.substr(all.size() - std::min<std::size_t>(all.size(), 800));
    }

    std::filesystem::path folder_;
};

}  // namespace bench
