// SPDX-License-Identifier: MIT
// What including a header costs the compiler, beside what others cost: one run of the compiler without code generation.
#include <cstdlib>
#include <string>

#include <benchmark/benchmark.h>

namespace {

void include(benchmark::State& state, const std::string& header) {
    const std::string command = std::string("echo '#include <") + header + ">' | " HEARTH_COMPILE " -fsyntax-only -x c++ -";
    for (auto _ : state) {
        if (std::system(command.c_str()) != 0) state.SkipWithError(("cannot compile " + header).c_str());
    }
}

const bool registered = [] {
    for (const char* header :
         {"vector", "regex", "Eigen/Core", "hearth/closure/gunn.hpp", "hearth/core/cell_graph.hpp",
          "hearth/voidage/vfs.hpp", "hearth/voidage/filtered_fraction.hpp", "hearth/hearth.hpp",
          "hearth/eigen.hpp"}) {
        std::string name = header;
        for (char& c : name) {
            if (c == '/') c = ' ';  // a slash would part family and method
        }
        benchmark::RegisterBenchmark(("compile time/" + name).c_str(), include, header)
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    }
    return true;
}();

}  // namespace
