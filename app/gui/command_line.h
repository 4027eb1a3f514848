#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mrose::gui {

/// What the command line asks for.
struct CommandLine {
    std::string file;        ///< to open; empty: the soccer scenario
    bool run = false;        ///< runs it to an end that is given, and ends
    bool offscreen = false;  ///< no display is used
    std::optional<std::int64_t> ticks;
    std::optional<double> duration;  ///< s
    std::optional<double> at;        ///< s
    std::optional<std::uint64_t> seed;
    std::uint32_t trial = 0;
    std::string variant;
    std::vector<std::string> overrides;
    std::vector<std::string> settings;
    std::string log;
    std::optional<double> start, every;  ///< s, of the log
    bool windows = false;
    std::vector<std::string> robots;  ///< of the log
    std::string robotFile;
    std::vector<std::string> models;  ///< to be laid over as well
    double pluginLimit = 2;           ///< s
    std::optional<double> speed;      ///< simulated seconds per second; 0: as fast as possible
    std::string select;               ///< a body's name, or its number from 1
    std::vector<std::string> layers;
    std::vector<std::string> breaks;  ///< texts of breakpoints
    bool dark = false;
    bool remember = false;                    ///< of the layout, where the window runs unattended
    std::optional<std::pair<int, int>> size;  ///< pixels
    std::string script, screenshot, record, film;
    bool overwrite = false, printHash = false, printKeys = false;

    /// A user works with the window, not a script alone.
    bool interactive() const { return !run && !offscreen && script.empty() && screenshot.empty() && film.empty(); }
};

/// A flag that says something of a log which is laid over its simulation, and nothing without one; empty: none is
/// given.
std::string flagOfALog(const CommandLine& line);

/// What it asks for, or the exit status where it has been answered: help, the version, or one line on standard error
/// and 2.
struct ParsedCommandLine {
    CommandLine line;
    std::optional<int> status;
};
ParsedCommandLine parseCommandLine(int argc, char** argv);

}  // namespace mrose::gui
