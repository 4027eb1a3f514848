#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "io/error.h"
#include "logs/robot_log.h"
#include "world/differential_drive.h"

namespace mrose {

/// A part of a robot's log that a simulated robot is to be driven by.
struct LogExcerpt {
    std::string log;         ///< the log's name, joined from where it is referred to
    std::string reference;   ///< as it is written there
    std::string robot;       ///< as the log calls it
    std::string trajectory;  ///< "": the first
    double start = 0;        ///< s after the log's start: what becomes the run's start
    /// How wheel commands are read, where the robot's network says it: as it was learned.
    std::optional<DifferentialDrive> drive = {};

    /// The name that its text is kept by.
    std::string name() const;
};

/// Where the texts of descriptions come from. Names are paths with '/', as given or joined from where they are referred
/// to; those that begin with "mrose:" are of what ships with the program, so that they mean the same on every machine.
class DescriptionSource {
public:
    virtual ~DescriptionSource() = default;

    /// The text of that name; nothing where there is none. Error: there is one that cannot be read.
    virtual Expected<std::optional<std::string>> text(const std::string& name) = 0;
    /// An excerpt of a log as a CSV log with the commands of one robot, of which one row has a pose: it is where the
    /// robot was at the run's start. Nothing where there is no such log. Error: it has no such robot or cannot be read.
    virtual Expected<std::optional<std::string>> excerpt(const LogExcerpt& excerpt) = 0;
    /// What a person calls the file of that name.
    virtual std::string shown(const std::string& name) const { return name; }
};

/// Files.
class DiskDescriptions final : public DescriptionSource {
public:
    struct Options {
        std::filesystem::path resources;  ///< the folder that holds resources/, shapes/ and nets/ as they ship
        std::vector<std::filesystem::path> logFolders;  ///< where logs are looked for after the referring file's folder
        std::string log;                                ///< not empty: read instead of every log that is referred to
    };
    explicit DiskDescriptions(Options options) : options_(std::move(options)) {}

    Expected<std::optional<std::string>> text(const std::string& name) override;
    Expected<std::optional<std::string>> excerpt(const LogExcerpt& excerpt) override;
    std::string shown(const std::string& name) const override;
    /// Where the log of an excerpt lies; nothing where none is found.
    std::optional<std::filesystem::path> logPlace(const LogExcerpt& excerpt) const;

private:
    Expected<const Log*> log(const std::filesystem::path& path, const DifferentialDrive& drive);

    Options options_;
    std::map<std::tuple<std::filesystem::path, double, double>, Log> logs_;  ///< by place and drive
};

/// Texts kept in memory, by name: of a recording, of a test.
class KeptDescriptions final : public DescriptionSource {
public:
    explicit KeptDescriptions(std::map<std::string, std::string> texts) : texts_(std::move(texts)) {}

    Expected<std::optional<std::string>> text(const std::string& name) override;
    Expected<std::optional<std::string>> excerpt(const LogExcerpt& excerpt) override { return text(excerpt.name()); }

private:
    std::map<std::string, std::string> texts_;
};

/// What begins the name of a file that ships with the program.
constexpr std::string_view shippedPrefix = "mrose:";

/// `reference` as seen from the file `from`: absolute ones as they are, others from its folder, without "." and "..".
std::string joinedName(const std::string& from, const std::string& reference);

}  // namespace mrose
