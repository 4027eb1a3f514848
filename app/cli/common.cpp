#include "common.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <unistd.h>

#include "io/shell_quoted.h"

namespace mrose::cli {
namespace {

std::string givenCommandLine;

/// Columns that a terminal needs for UTF-8 text without wide characters.
std::size_t displayWidth(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

CLI::App* addSubcommand(CLI::App& app, CommonFlags& flags, const std::string& name, const std::string& description,
                        const std::string& examples) {
    CLI::App* sub = app.add_subcommand(name, description);
    sub->footer("Examples:\n" + examples);
    sub->add_flag("-q,--quiet", flags.quiet, "No progress, and no summary of a file that is written");
    sub->add_flag("--json", flags.json, "Print the result as JSON");
    return sub;
}

void addSeed(CLI::App& sub, CommonFlags& flags) {
    sub.add_option("--seed", flags.seed, "Seed of everything random; the same seed gives the same result")
        ->check(someSeed())
        ->capture_default_str();
}

void addThreads(CLI::App& sub, CommonFlags& flags) {
    sub.add_option("--threads", flags.threads, "Threads to use; 0: all processors. Results do not depend on it")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
}

void addOverwrite(CLI::App& sub, CommonFlags& flags) {
    sub.add_flag("--overwrite", flags.overwrite, "Replace outputs that are there already");
}

int report(const Error& error) {
    std::fprintf(stderr, "mrose: %s\n", error.message().c_str());
    return failure;
}

void reportNotes(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) report({"", 0, 0, "note", note});
}

int reportInterrupted() {
    std::fprintf(stderr, "mrose: interrupted; nothing written\n");
    return interruptedStatus();
}

bool goesOn(double) { return !wasInterrupted(); }

std::string commandLine() { return givenCommandLine; }

void rememberCommandLine(int argc, char** argv) {
    givenCommandLine = "mrose";
    for (int i = 1; i < argc; ++i) givenCommandLine += ' ' + shellQuoted(argv[i]);
}

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::clear() {
    if (std::exchange(shown_, false)) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(const std::string& text) {
    if (quiet_) return;
    std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", text.c_str());
    std::fflush(stderr);
    shown_ = terminal_;
}

bool LearningDisplay::operator()(double share) {
    const int percent = static_cast<int>(100 * share), step = line_.terminal() ? percent : percent / 10;
    if (std::exchange(shown_, step) != step) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
        line_.show(what_ + ": " + std::to_string(percent) + " %" +
                   (percent > 0 && percent < 100
                        ? ", about " + durationText(spent.count() / share * (1 - share)) + " left"
                        : ""));
    }
    return !wasInterrupted();
}

std::string durationText(double seconds) {
    const long whole = std::lround(seconds), milliseconds = std::lround(1000 * seconds);
    char text[48];
    if (milliseconds < 1000)
        std::snprintf(text, sizeof text, "%ld ms", milliseconds);
    else if (whole < 60)
        std::snprintf(text, sizeof text, "%ld s", whole);
    else
        std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
    return text;
}

std::string TextTable::text() const {
    std::vector<std::size_t> widths(rows_.front().size());
    for (const auto& row : rows_)
        for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], displayWidth(row[c]));
    std::string out;
    for (const auto& row : rows_) {
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c) {
            const std::string padding(widths[c] - displayWidth(row[c]), ' ');
            line += c == 0 ? row[c] + padding : "  " + padding + row[c];
        }
        out += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
    }
    return out;
}

}  // namespace mrose::cli
