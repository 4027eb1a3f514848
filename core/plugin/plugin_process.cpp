#include "plugin/plugin_process.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mrose {
namespace {

constexpr int childSocket = 3;

/// What a child gets: the socket, no input, its output beside the errors, a process group of its own so that Ctrl-C
/// reaches the program alone.
struct SpawnSettings {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;

    explicit SpawnSettings(int socket) {
        ::posix_spawn_file_actions_init(&files);
        ::posix_spawn_file_actions_adddup2(&files, socket, childSocket);
        ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        ::posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
        ::posix_spawnattr_init(&attributes);
        sigset_t none, all;
        ::sigemptyset(&none);
        ::sigfillset(&all);
        ::posix_spawnattr_setsigmask(&attributes, &none);
        ::posix_spawnattr_setsigdefault(&attributes, &all);
        ::posix_spawnattr_setpgroup(&attributes, 0);
        ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;
    ~SpawnSettings() {
        ::posix_spawn_file_actions_destroy(&files);
        ::posix_spawnattr_destroy(&attributes);
    }
};

}  // namespace

Expected<std::unique_ptr<PluginProcess>> PluginProcess::start(const std::vector<std::string>& words) {
    int sockets[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0)
        return fail(words.front(), std::string("cannot be started: ") + std::strerror(errno));
    const std::string number = std::to_string(childSocket);
    std::vector<char*> raw;
    for (const std::string& word : words) raw.push_back(const_cast<char*>(word.c_str()));
    raw.push_back(const_cast<char*>(number.c_str()));
    raw.push_back(nullptr);
    pid_t child = -1;
    const SpawnSettings settings(sockets[1]);
    const int failed = ::posix_spawn(&child, raw[0], &settings.files, &settings.attributes, raw.data(), environ);
    ::close(sockets[1]);
    if (failed != 0) {
        ::close(sockets[0]);
        return fail(words.front(), std::string("cannot be started: ") + std::strerror(failed));
    }
    return std::unique_ptr<PluginProcess>(new PluginProcess(child, sockets[0]));
}

PluginProcess::~PluginProcess() {
    if (child_ < 0) return;
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

tl::expected<std::string, std::string> PluginProcess::ask(const std::string& message, double limit) {
    using Clock = std::chrono::steady_clock;
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit));
    std::string answer;
    MessageChannel::Outcome outcome = channel_.send(message, deadline);
    if (outcome == MessageChannel::Outcome::done) outcome = channel_.receive(answer, deadline);
    if (outcome == MessageChannel::Outcome::done) return answer;
    return tl::unexpected(failure(outcome, limit));
}

std::string PluginProcess::failure(MessageChannel::Outcome outcome, double limit) {
    if (outcome == MessageChannel::Outcome::closed) return howItEnded();
    if (outcome == MessageChannel::Outcome::unsound) return "was sent or sent more than fits a message";
    char text[60];
    std::snprintf(text, sizeof text, "took longer than %g s", limit);
    return text;
}

std::string PluginProcess::howItEnded() {
    // The socket closes a moment before the process is gone.
    constexpr int moment = 10'000;  // ms, on a busy machine
    if (const auto descriptor = static_cast<int>(::syscall(SYS_pidfd_open, child_, 0)); descriptor >= 0) {
        pollfd waiting{descriptor, POLLIN, 0};
        ::poll(&waiting, 1, moment);
        ::close(descriptor);
    }
    int status = 0;
    if (::waitpid(child_, &status, WNOHANG) != child_) return "closed its connection";
    child_ = -1;
    if (WIFEXITED(status)) return "ended with status " + std::to_string(WEXITSTATUS(status));
    const char* const meaning = ::sigdescr_np(WTERMSIG(status));
    return "ended by signal " + std::to_string(WTERMSIG(status)) + " (" + (meaning != nullptr ? meaning : "?") + ')';
}

}  // namespace mrose
