#include "support/workshop.h"

#include <algorithm>
#include <cstdlib>

#include "identification/planted_log.h"
#include "io/file.h"
#include "logs/csv_writer.h"

namespace mrose {

std::string plantedCsv() {
    Log log;
    RobotLog robot;
    robot.robot = "planted";
    for (int i = 0; i < 4; ++i) {
        Plant plant;
        plant.duration = 25;
        plant.seed = static_cast<std::uint64_t>(i + 1);
        robot.trajectories.push_back(plantedTrajectory(plant));
        robot.trajectories.back().name = "run" + std::to_string(i);
        robot.trajectories.back().group = i;
    }
    log.robots.push_back(std::move(robot));
    return toCsv(log);
}

std::string Workshop::read(const std::string& name) const { return readFile(path(name)).value_or(""); }

std::vector<std::string> Workshop::listing() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
        names.push_back(entry.path().lexically_relative(folder_.path()).string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string Workshop::log() {
    if (!std::filesystem::exists(path("log.csv"))) write("log.csv", plantedCsv());
    return path("log.csv");
}

namespace {

/// What this build of the tests learned once, kept beside it for its other processes.
std::filesystem::path keptNetwork() {
    return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "workshop.net";
}

bool isKept() {
    std::error_code missing;
    const auto kept = std::filesystem::last_write_time(keptNetwork(), missing);
    return !missing && kept > std::filesystem::last_write_time("/proc/self/exe");
}

}  // namespace

std::string Workshop::network() {
    if (std::filesystem::exists(path("a.net"))) return path("a.net");
    const std::string known = log();
    if (isKept()) return write("a.net", readFile(keptNetwork()).value_or(""));
    const auto trained = trainNetwork(training(known, path("a.net")));
    EXPECT_TRUE(trained) << trained.error().message();
    EXPECT_TRUE(writeFileAtomically(keptNetwork(), read("a.net")));
    return path("a.net");
}

TrainRequest Workshop::training(const std::string& log, const std::string& out) {
    TrainRequest request;
    request.logs.sources = {log};
    request.output = out;
    request.epochs = 20;
    request.members = 1;
    request.folds = 2;
    request.hidden = 6;
    return request;
}

std::string Workshop::windows() {
    std::string text = "dataset,robot,t_start,trajectory\n";
    for (int i = 0; i < 4; ++i) text += "0,planted,1700000003.5,run" + std::to_string(i) + '\n';
    return write("windows.csv", text);
}

ProgramResult runWithData(const std::string& folder, const std::vector<std::string>& words) {
    const char* const before = std::getenv("MROSE_DATA");
    const std::string kept = before == nullptr ? "" : before;
    setenv("MROSE_DATA", folder.c_str(), 1);
    ProgramResult result = runMrose(words);
    if (before == nullptr)
        unsetenv("MROSE_DATA");
    else
        setenv("MROSE_DATA", kept.c_str(), 1);
    return result;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string firstLines(const std::string& text, int count) {
    std::size_t end = 0;
    for (int i = 0; i < count; ++i) end = text.find('\n', end) + 1;
    return text.substr(0, end);
}

void expectOneLine(const ProgramResult& result, const std::vector<std::string>& parts, int status) {
    EXPECT_EQ(result.status, status) << result.out << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.starts_with("mrose: ") && result.err.ends_with('\n')) << result.err;
    for (const std::string& part : parts) EXPECT_NE(result.err.find(part), std::string::npos) << result.err << part;
}

}  // namespace mrose
