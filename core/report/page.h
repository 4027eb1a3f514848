#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assessment/assess.h"
#include "drawing/markup.h"
#include "io/error.h"
#include "io/file.h"

namespace mrose {

/// What is said of a drive that would teach a network most. All of it is plain text.
struct DriveAdvice {
    std::string drive;                 ///< "120 s, in 3.1 x 2.7 m"
    std::vector<std::string> reasons;  ///< what it is made of, and why
    std::string command;               ///< that writes it
    std::string missing;               ///< why there is none; then all else is empty
};

/// What a report says beside the numbers. All of it is plain text.
struct ReportContext {
    std::string program;               ///< "mrose 0.1.0"
    std::string commandLine;           ///< that made the report
    std::vector<std::string> notices;  ///< sentences that a reader must know before the numbers
    /// About the first model, which the report is about: "file", "inputs", "dead time", "seed", ... in this order.
    std::vector<std::pair<std::string, std::string>> modelFacts;
    std::vector<LogFile> trainingLogs;  ///< of the first model
    std::vector<std::size_t> chosen;    ///< further windows whose paths are shown, indices into LogWindows::windows
    /// Of the first model, by window: the share of its periods in which the robot was driven as it was never learned;
    /// empty: it does not say where it was.
    std::vector<double> unfamiliar = {};
    std::optional<DriveAdvice> advice = {};  ///< nullopt: it was not asked for
};

// What reports are put together from; all contents are markup.

/// <tag class="...">content</tag>.
std::string element(std::string_view tag, std::string_view cssClass, std::string_view content);

/// A whole page that needs nothing else, with its style sheet.
std::string reportPage(std::string_view title, std::string_view body);
/// What a page is about.
struct PageSource {
    std::string_view log;
    bool synthetic = false;
    std::string_view kind = "log";
};
/// Title, a line below it, and sentences (plain text) that must be read before the numbers.
std::string pageHead(std::string_view title, std::string_view subtitle, const PageSource& source,
                     const ReportContext& context, const std::vector<std::string>& notices);

std::string heading(std::string_view content);
std::string paragraph(std::string_view content);
/// A term of a list of definitions, and what it means.
std::string definition(std::string_view term, std::string_view meaning);
std::string card(std::string_view title, std::string_view content);
std::string cardPair(std::string_view first, std::string_view second);
/// A figure of positions and one of headings.
std::string figurePair(std::string_view position, std::string_view heading);
std::string tableCard(std::string_view content);
/// What to drive next.
std::string adviceCard(const DriveAdvice& advice);

/// A table with a header row. Cells are markup; the first column is a row header, the others are numbers aligned right
/// unless said otherwise.
class HtmlTable {
public:
    /// Columns under one heading.
    struct Group {
        std::string heading;
        std::vector<std::string> columns;
    };
    explicit HtmlTable(const std::vector<Group>& groups, std::string cssClass = {});

    void part(std::string_view content);  ///< a row that heads those below it
    void row(const std::vector<std::string>& cells);
    std::string text() const;

private:
    std::size_t columns_ = 0;
    std::string cssClass_, head_, rows_;
};

/// "Real" of "real".
std::string capitalised(std::string text);
/// With so many decimals; nothing of what is not finite.
std::string knownText(double value, int decimals);
/// "2.65 %", never broken between the number and its unit.
std::string percentText(double value);
/// "10 s", or "1.0 to 1.9 s" where they differ in length.
std::string lengthText(Nanoseconds shortest, Nanoseconds longest);

/// Of fewer windows a bootstrap's interval or a 90th percentile says nothing, and pages leave it out.
constexpr std::size_t leastForInterval = 20, leastForPercentile = 10;

/// "off by 2.65 % of the path driven (P) and its heading by ...".
std::string offText(const Summary& summary);
/// What P and Hd mean, as summed over `windows`: what they are called here.
std::string errorDefinitions(const WindowOptions& options, std::string_view windows);

/// The distribution's 90th percentile, or nothing where it is of too few.
std::string p90Text(const Distribution& distribution, double unit, int decimals);

/// A figure in large with its label above it and what more there is to say below it, in a row of such.
std::string tile(std::string_view label, std::string_view value, std::string_view unit, std::string_view more);
std::string tileRow(std::string_view tiles);

/// P, Hd and the errors at the end, large.
std::string tiles(const Summary& summary);

/// What was wrong with the log, one row per robot.
std::string defectTable(const LogWindows& log);
/// Files with their hashes.
/// A row of a table of two columns for each of the facts about the model.
void addModelFacts(HtmlTable& table, const ReportContext& context);

std::string fileTable(const std::vector<LogFile>& files);
/// The same, to be unfolded; nothing of none.
std::string foldedFiles(const std::vector<LogFile>& files);

/// Error unless files of these names could be written into `folder`, which need not be there, or where one is there
/// already, without `overwrite`. Nothing is made.
Expected<void> checkReportFolder(const std::filesystem::path& folder, std::span<const char* const> names,
                                 bool overwrite);

/// Writes files, whose paths are seen from `folder`, which is made where it is missing: all of them or none.
Expected<void> writeReportFiles(const std::filesystem::path& folder, std::vector<NamedFile> files);

}  // namespace mrose
