#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "io/error.h"
#include "logs/robot_log.h"
#include "scenario/log_player.h"

namespace mrose {

/// Where the texts of descriptions come from. Names are paths with '/', as given or joined from where they are referred
/// to; those that begin with "mrose:" are of what ships with the program, so that they mean the same on every machine.
class DescriptionSource {
public:
    virtual ~DescriptionSource() = default;

    /// The text of that name; nullopt where there is none. Error: there is one that cannot be read.
    virtual Expected<std::optional<std::string>> text(const std::string& name) = 0;
    /// A robot's part of a log, its commands first. nullopt where there is no such log. Error: it has no such robot or
    /// cannot be read.
    virtual Expected<std::optional<ExcerptContent>> excerpt(const LogExcerpt& excerpt) = 0;
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
    Expected<std::optional<ExcerptContent>> excerpt(const LogExcerpt& excerpt) override;
    std::string shown(const std::string& name) const override;
    /// Hashes of the files that were read, by their paths.
    const std::map<std::string, std::string>& hashes() const { return hashes_; }
    /// Where the log of an excerpt lies; nullopt where none is found.
    std::optional<std::filesystem::path> logPlace(const LogExcerpt& excerpt) const;

private:
    Expected<const Log*> logAt(const std::filesystem::path& path, const DifferentialDrive& drive);

    Options options_;
    std::map<std::tuple<std::filesystem::path, double, double>, Log> logs_;  ///< by place and drive
    std::map<std::string, std::string> hashes_;
};

/// Texts kept in memory, by name: of an old recording, of a test. Excerpts of logs are kept as CSV logs by
/// LogExcerpt::name().
class KeptDescriptions final : public DescriptionSource {
public:
    explicit KeptDescriptions(std::map<std::string, std::string> texts) : texts_(std::move(texts)) {}

    Expected<std::optional<std::string>> text(const std::string& name) override;
    Expected<std::optional<ExcerptContent>> excerpt(const LogExcerpt& excerpt) override;

private:
    std::map<std::string, std::string> texts_;
};

/// No files at all: for scenarios that hold all that they are made of.
class NoDescriptions final : public DescriptionSource {
public:
    Expected<std::optional<std::string>> text(const std::string&) override { return std::nullopt; }
    Expected<std::optional<ExcerptContent>> excerpt(const LogExcerpt&) override { return std::nullopt; }
};

/// What begins the name of a file that ships with the program.
constexpr std::string_view shippedPrefix = "mrose:";

/// `reference` as seen from the file `from`: absolute ones as they are, others from its folder, without "." and "..".
std::string joinedName(const std::string& from, const std::string& reference);

}  // namespace mrose
