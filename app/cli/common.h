#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "io/error.h"
#include "shared/flag_checks.h"
#include "shared/interrupts.h"

namespace mrose::cli {

/// Beside interruptedStatus().
enum ExitStatus : int { success = 0, failure = 1, usage = 2 };

/// Flags with the same meaning in every subcommand.
struct CommonFlags {
    std::uint64_t seed = 1;
    int threads = 0;  ///< 0: as many as the machine has
    bool quiet = false;
    bool json = false;
    bool overwrite = false;  ///< outputs that are there already
};

/// A subcommand registers itself and gives what runs when it was chosen.
using Run = std::function<int()>;
struct Subcommand {
    CLI::App* app;
    Run run;
};
Subcommand addInspect(CLI::App& app, CommonFlags& flags);
Subcommand addTrain(CLI::App& app, CommonFlags& flags);
Subcommand addEvaluate(CLI::App& app, CommonFlags& flags);
Subcommand addPredict(CLI::App& app, CommonFlags& flags);
Subcommand addAdvise(CLI::App& app, CommonFlags& flags);
Subcommand addGenerate(CLI::App& app, CommonFlags& flags);
Subcommand addSheet(CLI::App& app, CommonFlags& flags);
Subcommand addIdentifyBall(CLI::App& app, CommonFlags& flags);
Subcommand addShapes(CLI::App& app, CommonFlags& flags);
Subcommand addRun(CLI::App& app, CommonFlags& flags);
Subcommand addReplay(CLI::App& app, CommonFlags& flags);
Subcommand addBatch(CLI::App& app, CommonFlags& flags);
Subcommand addExperiment(CLI::App& app, CommonFlags& flags);
Subcommand addLearn(CLI::App& app, CommonFlags& flags);
Subcommand addTune(CLI::App& app, CommonFlags& flags);
Subcommand addValidate(CLI::App& app, CommonFlags& flags);
Subcommand addCompare(CLI::App& app, CommonFlags& flags);

/// A subcommand with --quiet, --json and, below its options, examples.
CLI::App* addSubcommand(CLI::App& app, CommonFlags& flags, const std::string& name, const std::string& description,
                        const std::string& examples);
// The other common flags, for subcommands in which they do something.
void addSeed(CLI::App& sub, CommonFlags& flags);
void addThreads(CLI::App& sub, CommonFlags& flags);
void addOverwrite(CLI::App& sub, CommonFlags& flags);

/// One line on standard error; returns ExitStatus::failure.
int report(const Error& error);
/// A line on standard error for each sentence.
void reportNotes(const std::vector<std::string>& notes);

/// Of what leaves nothing when it is interrupted: says so; returns interruptedStatus().
int reportInterrupted();

/// Progress that nothing is shown of: whether the program was not interrupted.
bool goesOn(double share);

/// The command line as it can be typed again.
std::string commandLine();
void rememberCommandLine(int argc, char** argv);

/// Progress on standard error: one line that is written over where that is a terminal, else a line each; nothing when
/// `quiet`.
class ProgressLine {
public:
    explicit ProgressLine(bool quiet);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(const std::string& text);
    void clear();                                ///< before anything else is printed
    bool terminal() const { return terminal_; }  ///< without one, few lines are wanted

private:
    bool quiet_, terminal_;
    bool shown_ = false;
};

/// How far learning has come, and about how long it still takes: without a terminal, about ten lines of it.
class LearningDisplay {
public:
    LearningDisplay(bool quiet, std::string what) : line_(quiet), what_(std::move(what)) {}

    bool operator()(double share);  ///< whether it may go on
    void end() { line_.clear(); }

private:
    ProgressLine line_;
    std::string what_;
    int shown_ = -1;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// "2 min 05 s", "12 s", "340 ms"
std::string durationText(double seconds);

/// A table of text with aligned columns, numbers to the right: what programs print for people.
class TextTable {
public:
    explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    std::string text() const;

private:
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace mrose::cli
