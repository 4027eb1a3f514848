#include "logs/mrclam_reader.h"

#include <charconv>
#include <map>

#include "io/file.h"
#include "logs/conditioning.h"
#include "logs/mrclam_measurements.h"
#include "logs/mrclam_rows.h"
#include "logs/row_check.h"

namespace mrose {
namespace {

constexpr std::string_view odometrySuffix = "_Odometry.dat", truthSuffix = "_Groundtruth.dat";
constexpr MrclamLayout<StampedCommand, 3> odometryLayout{{"time", "v", "w"},
                                                         [](StampedCommand& sample, const double* numbers) {
                                                             sample.command = {numbers[0], numbers[1]};
                                                         }};
constexpr MrclamLayout<StampedPose, 4> truthLayout{{"time", "x", "y", "heading"},
                                                   [](StampedPose& sample, const double* numbers) {
                                                       sample.pose = {numbers[0], numbers[1], numbers[2]};
                                                   }};

/// The N of "Robot<N><suffix>".
std::optional<int> robotNumber(std::string_view fileName, std::string_view suffix) {
    constexpr std::string_view prefix = "Robot";
    if (!fileName.starts_with(prefix) || !fileName.ends_with(suffix)) return std::nullopt;
    if (fileName.size() <= prefix.size() + suffix.size()) return std::nullopt;
    const std::string_view digits = fileName.substr(prefix.size(), fileName.size() - prefix.size() - suffix.size());
    int number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc{} || end != digits.data() + digits.size() || number < 0) return std::nullopt;
    return number;
}

std::filesystem::path truthFile(const std::filesystem::path& folder, int number) {
    return folder / ("Robot" + std::to_string(number) + std::string(truthSuffix));
}

std::map<int, std::filesystem::path> odometryFiles(const std::filesystem::path& folder) {
    std::map<int, std::filesystem::path> files;
    std::error_code ignored;
    for (std::filesystem::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
         entry.increment(ignored))
        if (const auto number = robotNumber(entry->path().filename().string(), odometrySuffix))
            files.emplace(*number, entry->path());
    return files;
}

/// The number at the end of the folder's name, 0 where there is none.
int datasetNumber(const std::filesystem::path& folder) {
    const auto trimmed = folder.has_filename() ? folder : folder.parent_path();
    const std::string name = trimmed.filename() == "." || trimmed.filename() == ".."
                                 ? std::filesystem::weakly_canonical(folder).filename().string()
                                 : trimmed.filename().string();
    const std::size_t digits = name.find_last_not_of("0123456789") + 1;
    int number = 0;
    std::from_chars(name.data() + digits, name.data() + name.size(), number);
    return number;
}

/// The rows of one of a log's files; none, and what is missing without them, where there are too few.
template <class Sample, std::size_t columns>
Expected<std::vector<Sample>> readRows(Log& log, const std::filesystem::path& path,
                                       const MrclamLayout<Sample, columns>& layout, const std::string& without,
                                       LogDefects& defects) {
    const auto content = readFile(path);
    if (!content) return tl::unexpected(content.error());
    log.files.push_back({path.string(), contentHash(*content)});
    const std::int64_t cutBefore = defects.cutLines;
    auto rows = MrclamRows(*content, path.string(), layout).parse(defects.cutLines);
    if (!rows) return rows;
    if (defects.cutLines > cutBefore) log.incomplete.push_back(cutLineText(path.string()));
    if (rows->size() >= fewestRows) return rows;
    log.incomplete.push_back(tooShortText(path.string(), rows->size()) + ": " + without);
    return std::vector<Sample>{};
}

Expected<RobotLog> readRobot(Log& log, int number, const std::filesystem::path& odometry, const LogOptions& options) {
    const std::string called = "robot " + std::to_string(number);
    RobotLog robot{std::to_string(number), {}, {}};
    Trajectory trajectory{.name = "whole"};
    auto commands = readRows<StampedCommand>(log, odometry, odometryLayout,
                                             "nothing says what was sent to " + called + '.', robot.defects);
    if (!commands) return tl::unexpected(commands.error());
    trajectory.commands = std::move(*commands);
    conditionCommands(trajectory.commands, options, robot.defects, &trajectory.blips);

    const auto truth = truthFile(odometry.parent_path(), number);
    if (std::filesystem::exists(truth)) {
        auto poses =
            readRows<StampedPose>(log, truth, truthLayout, "nothing says where " + called + " was.", robot.defects);
        if (!poses) return tl::unexpected(poses.error());
        trajectory.poses = std::move(*poses);
        conditionPoses(trajectory.poses, options, robot.defects);
    }
    if (!trajectory.commands.empty() || !trajectory.poses.empty()) robot.trajectories.push_back(std::move(trajectory));
    return robot;
}

/// Where some robots have a file of ground truth, those without it lack it.
void reportMissingTruth(Log& log, const std::filesystem::path& folder) {
    std::vector<std::string> missing;
    for (const RobotLog& robot : log.robots) {
        const auto truth = truthFile(folder, std::stoi(robot.robot));
        if (!std::filesystem::exists(truth))
            missing.push_back(truth.filename().string() + " is missing: nothing says where robot " + robot.robot +
                              " was.");
    }
    if (missing.size() < log.robots.size()) log.incomplete.insert(log.incomplete.end(), missing.begin(), missing.end());
}

}  // namespace

bool isMrclamFolder(const std::filesystem::path& folder) { return !odometryFiles(folder).empty(); }

Expected<Log> readMrclam(const std::filesystem::path& folder, const LogOptions& options) {
    Log log{folder.string(), "mrclam", datasetNumber(folder), {}, {}};
    const auto files = odometryFiles(folder);
    if (files.empty()) return fail(folder.string(), "holds no Robot<N>_Odometry.dat");
    for (const auto& [number, path] : files) {
        auto robot = readRobot(log, number, path, options);
        if (!robot) return tl::unexpected(robot.error());
        log.robots.push_back(std::move(*robot));
    }
    reportMissingTruth(log, folder);
    std::erase_if(log.robots, [](const RobotLog& robot) { return robot.trajectories.empty(); });
    if (log.robots.empty()) return fail(folder.string(), tooShortCause(0));
    if (auto read = readMrclamMeasurements(log, folder); !read) return tl::unexpected(read.error());
    return log;
}

Expected<std::vector<StampedCommand>> parseMrclamOdometry(std::string_view content, const std::string& name,
                                                          LogDefects& defects) {
    return MrclamRows(content, name, odometryLayout).parse(defects.cutLines);
}

Expected<std::vector<StampedPose>> parseMrclamGroundtruth(std::string_view content, const std::string& name,
                                                          LogDefects& defects) {
    return MrclamRows(content, name, truthLayout).parse(defects.cutLines);
}

}  // namespace mrose
