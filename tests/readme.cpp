// SPDX-License-Identifier: MIT
// The READMEs and the pages beside them cannot rot.  In every .md of the tree
//   - a block of C++ or CMake stands below a line `<!-- FILE -->` or `<!-- FILE: REGION -->` and is, word for word, that
//     file without its licence line, or the part of it between two lines `// [REGION]` (`# [REGION]` in CMake);
//   - a preset that a shell block names is a workflow preset;
//   - a link to a file of the tree leads to one.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

const fs::path root = HEARTH_SOURCE_DIR;

std::vector<std::string> lines_of(std::istream& text) {
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

std::vector<std::string> read(const fs::path& file) {
    std::ifstream stream(file);
    return lines_of(stream);
}

std::string trimmed(const std::string& line) {
    const auto first = line.find_first_not_of(' ');
    return first == std::string::npos ? "" : line.substr(first);
}

/// Takes away the blank lines at both ends and the indentation that all lines share.
std::vector<std::string> unindented(std::vector<std::string> lines) {
    const auto blank = [](const std::string& line) { return trimmed(line).empty(); };
    while (!lines.empty() && blank(lines.front())) lines.erase(lines.begin());
    while (!lines.empty() && blank(lines.back())) lines.pop_back();
    std::size_t indent = std::string::npos;
    for (const auto& line : lines) indent = std::min(indent, line.find_first_not_of(' '));
    for (auto& line : lines) line.erase(0, std::min(indent, line.size()));
    return lines;
}

/// A region of a file, or the whole file without its licence line; empty where there is none.
std::vector<std::string> excerpt(const fs::path& file, const std::string& region) {
    std::vector<std::string> lines = read(file);
    if (region.empty()) {
        if (!lines.empty() && lines.front().find("SPDX") != std::string::npos) lines.erase(lines.begin());
        return unindented(lines);
    }
    const auto is_marker = [&](const std::string& line) {
        return trimmed(line) == "// [" + region + "]" || trimmed(line) == "# [" + region + "]";
    };
    const auto begin = std::find_if(lines.begin(), lines.end(), is_marker);
    if (begin == lines.end()) return {};
    const auto end = std::find_if(begin + 1, lines.end(), is_marker);
    return unindented({begin + 1, end});
}

/// The names of the workflow presets.
std::vector<std::string> workflows() {
    std::ifstream stream(root / "CMakePresets.json");
    std::stringstream text;
    text << stream.rdbuf();
    std::string presets = text.str();
    presets.erase(0, presets.find("\"workflowPresets\""));
    std::vector<std::string> names;
    const std::regex name("\"name\": \"([a-z0-9-]+)\", \"steps\"");
    for (std::sregex_iterator i(presets.begin(), presets.end(), name), end; i != end; ++i) names.push_back((*i)[1]);
    return names;
}

/// What is wrong with a page that stands in `folder`.
std::vector<std::string> problems(const std::vector<std::string>& readme, const fs::path& folder) {
    std::vector<std::string> found;
    const auto report = [&](std::size_t line, const std::string& what) {
        found.push_back("line " + std::to_string(line + 1) + ": " + what);
    };
    const std::vector<std::string> presets = workflows();
    const std::regex marker("<!-- ([^ :]+)(: ([^ ]+))? -->");
    const std::regex preset("--preset[ =]([A-Za-z0-9-]+)");
    const std::regex link("\\]\\(([^)#:]+)\\)");

    for (std::size_t i = 0; i < readme.size(); ++i) {
        if (readme[i].rfind("```", 0) != 0) {
            for (std::sregex_iterator m(readme[i].begin(), readme[i].end(), link), end; m != end; ++m) {
                if (!fs::exists(folder / (*m)[1].str())) report(i, "no file " + (*m)[1].str());
            }
            continue;
        }
        const std::size_t fence = i;
        const std::string language = readme[fence].substr(3);
        std::vector<std::string> block;
        while (++i < readme.size() && readme[i] != "```") block.push_back(readme[i]);

        if (language == "cpp" || language == "cmake") {
            std::smatch m;
            if (fence == 0 || !std::regex_match(readme[fence - 1], m, marker)) {
                report(fence, "no line <!-- FILE --> above this block");
            } else if (const auto source = excerpt(root / m[1].str(), m[3]); source.empty()) {
                report(fence, "nothing to be found under " + m[0].str());
            } else if (source != unindented(block)) {
                report(fence, "differs from " + m[0].str());
            }
        } else if (language == "sh") {
            for (std::size_t k = 0; k < block.size(); ++k) {
                for (std::sregex_iterator m(block[k].begin(), block[k].end(), preset), end; m != end; ++m) {
                    if (std::find(presets.begin(), presets.end(), (*m)[1].str()) == presets.end()) {
                        report(fence + 1 + k, "no workflow preset " + (*m)[1].str());
                    }
                }
            }
        } else if (language.empty()) {
            report(fence, "this block does not name its language");
        }
    }
    return found;
}

std::vector<std::string> problems(const std::string& readme) {
    std::istringstream text(readme);
    return problems(lines_of(text), root);
}

}  // namespace

TEST_CASE("readme: every block of code is part of a file of the tree, every preset and link exists") {
    int pages = 0;
    for (auto file = fs::recursive_directory_iterator(root); file != fs::recursive_directory_iterator(); ++file) {
        const std::string name = file->path().filename().string();
        if (file->is_directory() && (name == "build" || name.front() == '.')) file.disable_recursion_pending();
        if (file->path().extension() != ".md") continue;
        ++pages;
        for (const std::string& problem : problems(read(file->path()), file->path().parent_path())) {
            FAIL_CHECK(fs::relative(file->path(), root).string() << " " << problem);
        }
    }
    CHECK(pages >= 2);
}

TEST_CASE("readme: the check finds what it must find") {
    using list = std::vector<std::string>;
    CHECK(problems("```cpp\nint i;\n```\n") == list{"line 1: no line <!-- FILE --> above this block"});
    CHECK(problems("<!-- tests/none.cpp -->\n```cpp\nint i;\n```\n") ==
          list{"line 2: nothing to be found under <!-- tests/none.cpp -->"});
    CHECK(problems("<!-- tests/readme.cpp: none -->\n```cpp\nint i;\n```\n") ==
          list{"line 2: nothing to be found under <!-- tests/readme.cpp: none -->"});
    CHECK(problems("<!-- tests/readme.cpp: sample -->\n```cpp\nconst int answer = 41;\n```\n") ==
          list{"line 2: differs from <!-- tests/readme.cpp: sample -->"});
    CHECK(problems("<!-- tests/readme.cpp: sample -->\n```cpp\nconst int answer = 42;\n```\n").empty());
    // [sample]
    const int answer = 42;
    // [sample]
    CHECK(answer == 42);
    CHECK(problems("```sh\ncmake --workflow --preset nonsense\n```\n") == list{"line 2: no workflow preset nonsense"});
    CHECK(problems("```sh\ncmake --workflow --preset test\n```\n").empty());
    CHECK(problems("```\nwhat is this\n```\n") == list{"line 1: this block does not name its language"});
    CHECK(problems("see [this](tests/none.md)\n") == list{"line 1: no file tests/none.md"});
    CHECK(problems("see [this](tests/readme.cpp) and [that](https://cmake.org)\n").empty());
}
