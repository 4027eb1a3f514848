// How fast logs open: MB/s of each format's reader from text to conditioned samples, and of readLog from the file (in
// the system's cache), beside a plain std::ifstream >> double over the same file. The ratio is printed at the end.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "logs/csv_reader.h"
#include "logs/husky_reader.h"
#include "logs/log_reader.h"
#include "logs/mrclam_reader.h"

namespace mrose {
namespace {

constexpr std::size_t megabyte = 1'000'000;
constexpr std::size_t size = 100 * megabyte;

/// Rows as in a ground truth file; every 12 to 27 ms, as the tracker's.
std::string mrclamTruth(std::size_t bytes) {
    std::string text = "# Time [s]    x [m]    y [m]    orientation [rad] \n";
    char row[128];
    for (std::int64_t i = 0, milliseconds = 0; text.size() < bytes; ++i, milliseconds += 12 + i * 7 % 16) {
        const double angle = static_cast<double>(milliseconds) * 1e-4;
        std::snprintf(row, sizeof row, "%lld.%03lld \t %.8f \t %.8f \t %.8f \n", 1248444175LL + milliseconds / 1000LL,
                      milliseconds % 1000LL, 2 * std::cos(angle), 3 * std::sin(angle),
                      std::remainder(angle, 6.283185307179586));
        text += row;
    }
    return text;
}

std::string csvText(std::size_t bytes) {
    std::string text = "t,v_cmd,w_cmd,x,y,heading\n";
    char row[160];
    for (std::int64_t i = 0; text.size() < bytes; ++i) {
        const double angle = static_cast<double>(i) * 1e-3;
        std::snprintf(row, sizeof row, "%lld.%02lld,%.3f,%.3f,%.6f,%.6f,%.6f\n", i / 100LL, i % 100LL, 0.3,
                      0.5 * std::sin(angle), 2 * std::cos(angle), 3 * std::sin(angle), angle);
        text += row;
    }
    return text;
}

void countBytes(benchmark::State& state, std::size_t bytes) {
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(bytes));
}

void mrclamFromText(benchmark::State& state) {
    const std::string text = mrclamTruth(size);
    LogDefects defects;
    for (auto _ : state) benchmark::DoNotOptimize(parseMrclamGroundtruth(text, "truth", defects).value().size());
    countBytes(state, text.size());
}
BENCHMARK(mrclamFromText)->Unit(benchmark::kMillisecond);

void csvFromText(benchmark::State& state) {
    const std::string text = csvText(size);
    for (auto _ : state) benchmark::DoNotOptimize(parseCsv(text, "log").value().robots.size());
    countBytes(state, text.size());
}
BENCHMARK(csvFromText)->Unit(benchmark::kMillisecond);

/// An MRCLAM folder for as long as it lives.
class TemporaryFolder {
public:
    TemporaryFolder()
        : path_(std::filesystem::temp_directory_path() / ("mrose_log_bench_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path_);
        std::ofstream(path_ / "Robot1_Odometry.dat") << "1248444175.0 0.1 0.0 \n1248444176.0 0.1 0.0 \n";
        std::ofstream(path_ / "Robot1_Groundtruth.dat") << mrclamTruth(size);
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double secondsOfStream(const std::filesystem::path& file) {
    const auto start = std::chrono::steady_clock::now();
    std::ifstream stream(file);
    std::string comment;
    std::getline(stream, comment);
    double sum = 0;
    for (double number; stream >> number;) sum += number;
    benchmark::DoNotOptimize(sum);
    return secondsSince(start);
}

void folderOpened(benchmark::State& state) {
    const TemporaryFolder folder;
    double ours = 0;
    for (auto _ : state) {
        const auto start = std::chrono::steady_clock::now();
        benchmark::DoNotOptimize(readLog(folder.path()).value().robots.size());
        ours += secondsSince(start);
    }
    ours /= static_cast<double>(state.iterations());
    const double plain = secondsOfStream(folder.path() / "Robot1_Groundtruth.dat");
    countBytes(state, size);
    state.counters["s_per_100MB"] = ours;
    state.counters["ifstream_s_per_100MB"] = plain;
    state.counters["times_faster"] = plain / ours;
}
BENCHMARK(folderOpened)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace mrose

BENCHMARK_MAIN();
