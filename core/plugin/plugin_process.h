#pragma once

#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

#include "io/error.h"
#include "plugin/message_channel.h"

namespace mrose {

/// A child process that serves a plug-in (plugin_host.h). It ends with this object, and never becomes a zombie.
class PluginProcess {
public:
    /// Starts `words`, a program and its arguments, followed by the number of the socket in it. Error: what the system
    /// says.
    static Expected<std::unique_ptr<PluginProcess>> start(const std::vector<std::string>& words);
    PluginProcess(const PluginProcess&) = delete;
    PluginProcess& operator=(const PluginProcess&) = delete;
    ~PluginProcess();

    /// Sends a message and waits for its answer; the error says what became of the process: "ended by signal 11
    /// (Segmentation fault)". It is of no use then.
    tl::expected<std::string, std::string> ask(const std::string& message, double limit);

private:
    PluginProcess(pid_t child, int socket) : child_(child), channel_(socket) {}
    std::string failure(MessageChannel::Outcome outcome, double limit);
    std::string howItEnded();

    pid_t child_;
    MessageChannel channel_;
};

}  // namespace mrose
