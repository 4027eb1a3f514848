#include "support/run_program.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/places.h"

namespace mrose {
namespace {

/// In the child, after fork: only what is safe there.
[[noreturn]] void become(char* const* words, char* const* environment, int out, int err,
                         const RunningProgram::Options& options) {
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    if (options.fullDisk) {
        const rlimit room{options.room, options.room};
        ::setrlimit(RLIMIT_FSIZE, &room);
        ::signal(SIGXFSZ, SIG_IGN);
    }
    // Whatever who runs the tests does with them.
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
    ::alarm(300);  // s; a program that should have ended and did not is ended, and the test fails
    ::execve(words[0], words, environment);
    ::_exit(127);
}

/// Reads what is there; false at the end.
bool readInto(int descriptor, std::string& text) {
    std::array<char, 4096> buffer;
    const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
    if (got > 0) text.append(buffer.data(), static_cast<std::size_t>(got));
    return got > 0 || (got < 0 && errno == EINTR);
}

void closeOnce(int& descriptor) {
    if (descriptor >= 0) ::close(descriptor);
    descriptor = -1;
}

}  // namespace

RunningProgram::RunningProgram(const std::vector<std::string>& words, const Options& options) {
    std::vector<char*> raw;
    for (const std::string& word : words) raw.push_back(const_cast<char*>(word.c_str()));
    raw.push_back(nullptr);
    std::vector<char*> environment;
    for (char** variable = environ; *variable != nullptr; ++variable) environment.push_back(*variable);
    if (!options.variable.empty()) environment.push_back(const_cast<char*>(options.variable.c_str()));
    environment.push_back(nullptr);
    int out[2], err[2];
    if (::pipe2(out, O_CLOEXEC) != 0) return;
    if (::pipe2(err, O_CLOEXEC) != 0) return;
    child_ = ::fork();
    if (child_ == 0) become(raw.data(), environment.data(), out[1], err[1], options);
    ::close(out[1]);
    ::close(err[1]);
    out_ = out[0];
    err_ = err[0];
}

RunningProgram::~RunningProgram() {
    if (child_ > 0) {
        send(SIGKILL);
        finish();
    }
}

bool RunningProgram::readSome() {
    std::array<pollfd, 2> waiting{{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};
    if (out_ < 0 && err_ < 0) return false;
    if (::poll(waiting.data(), waiting.size(), -1) < 0) return errno == EINTR;
    if (waiting[0].revents != 0 && !readInto(out_, result_.out)) closeOnce(out_);
    if (waiting[1].revents != 0 && !readInto(err_, result_.err)) closeOnce(err_);
    return true;
}

bool RunningProgram::waitForError(const std::string& text) {
    while (result_.err.find(text) == std::string::npos)
        if (!readSome()) return false;
    return true;
}

void RunningProgram::waitUntilAsleep() const {
    const std::string file = "/proc/" + std::to_string(child_) + "/stat";
    for (;;) {
        std::ifstream status(file);
        std::string line;
        std::getline(status, line);
        const std::size_t name = line.rfind(") ");  // "1234 (mrose) S ..."
        if (name == std::string::npos || line.size() < name + 3) return;
        if (line[name + 2] == 'S' || line[name + 2] == 'Z') return;
        ::sched_yield();
    }
}

void RunningProgram::send(int signal) {
    if (child_ > 0) ::kill(child_, signal);
}

ProgramResult RunningProgram::finish() {
    while (readSome()) {
    }
    int status = 0;
    if (child_ > 0 && ::waitpid(child_, &status, 0) == child_)
        result_.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    child_ = -1;
    return result_;
}

ProgramResult runMrose(const std::vector<std::string>& arguments, const RunningProgram::Options& options) {
    std::vector<std::string> words{mroseProgram()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return RunningProgram(words, options).finish();
}

}  // namespace mrose
