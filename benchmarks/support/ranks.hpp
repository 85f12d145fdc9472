// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstring>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>
#include <mpi.h>

#include "support/counters.hpp"

namespace bench {

/// Lets rank 0 work alone: the others sleep, and take no core from it.
template <class Work>
void alone(int rank, Work&& work) {
    if (rank == 0) work();
    MPI_Request done;
    MPI_Ibarrier(MPI_COMM_WORLD, &done);
    for (int there = 0; !there;) {
        MPI_Test(&done, &there, MPI_STATUS_IGNORE);
        if (!there) std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
}

class silent_reporter : public benchmark::BenchmarkReporter {
  public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>&) override {}
};

/// Runs what is registered on every rank; only rank 0 prints and writes.
inline void run_on_ranks(int rank, int argc, char** argv) {
    if (rank == 0) {
        benchmark::Initialize(&argc, argv);
        benchmark::RunSpecifiedBenchmarks();
    } else {
        // The other ranks take the filter, but write no file.
        std::vector<char*> arguments;
        for (int k = 0; k < argc; ++k)
            if (std::strstr(argv[k], "--benchmark_out") == nullptr) arguments.push_back(argv[k]);
        int count = static_cast<int>(arguments.size());
        benchmark::Initialize(&count, arguments.data());
        silent_reporter none;
        benchmark::RunSpecifiedBenchmarks(&none);
    }
    benchmark::Shutdown();
}

}  // namespace bench
