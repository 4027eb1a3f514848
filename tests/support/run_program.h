#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sys/types.h>

namespace mrose {

struct ProgramResult {
    int status = -1;  ///< exit status; 128 + the signal that ended it
    std::string out, err;
};

/// A program under way, with both of its outputs on pipes.
class RunningProgram {
public:
    struct Options {
        bool fullDisk = false;   ///< writes to files fail, as on a full disk ...
        std::uint64_t room = 0;  ///< ... beyond so many bytes of a file
        std::string variable;    ///< "NAME=VALUE", added to its environment; empty: none
    };

    /// `words` are the program's path and its arguments.
    explicit RunningProgram(const std::vector<std::string>& words, const Options& options);
    explicit RunningProgram(const std::vector<std::string>& words) : RunningProgram(words, Options{}) {}
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;
    ~RunningProgram();

    /// Waits for this text on standard error; false: the program ended before.
    bool waitForError(const std::string& text);
    /// Waits until its first thread sleeps, or the program has ended.
    void waitUntilAsleep() const;
    void send(int signal);
    /// Waits for the end.
    ProgramResult finish();

private:
    bool readSome();

    pid_t child_ = -1;
    int out_ = -1, err_ = -1;
    ProgramResult result_;
};

/// Runs the program `mrose` of this build to its end.
ProgramResult runMrose(const std::vector<std::string>& arguments, const RunningProgram::Options& options = {});

}  // namespace mrose
