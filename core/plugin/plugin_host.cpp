#include "plugin/plugin_host.h"

#include <csignal>
#include <memory>
#include <thread>

#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include "messages/decision_bytes.h"
#include "messages/memory_entry_bytes.h"
#include "messages/observation_bytes.h"
#include "messages/text_bytes.h"
#include "plugin/load_plugin.h"
#include "plugin/message_channel.h"
#include "plugin/plugin_message.h"

namespace mrose {
namespace {

class PluginServer {
public:
    /// The answer to a message; empty where it is none that a program sends.
    std::string answer(std::string_view message) {
        ByteReader reader(message);
        const auto kind = static_cast<PluginMessage>(reader.number<std::uint8_t>());
        if (kind == PluginMessage::load) return load(reader);
        if (!controller_) return "";
        if (kind == PluginMessage::commands) return commands(reader);
        if (kind == PluginMessage::decide) return decide(reader);
        if (kind == PluginMessage::explain) return explain(reader);
        return "";
    }

private:
    static std::string begin(PluginMessage kind) { return std::string(1, static_cast<char>(kind)); }

    std::string load(ByteReader& reader) {
        std::string path, options;
        if (!readText(reader, path) || !readText(reader, options) || !reader.done()) return "";
        const auto loaded = loadPlugin(path, options);
        if (!loaded) {
            std::string bytes = begin(PluginMessage::refused);
            appendText(loaded.error().key, bytes);
            appendText(loaded.error().cause, bytes);
            return bytes;
        }
        controller_ = *loaded;
        memory_.assign(controller_->memorySize(), '\0');
        controller_->start(memory());
        std::string bytes = begin(PluginMessage::loaded);
        attention_ = controller_->attention();
        observation_.leaveOut(&attention_);
        appendAttention(attention_, bytes);
        return bytes + memory_;
    }

    std::string commands(ByteReader& reader) const {
        const auto period = reader.number<Nanoseconds>();
        std::string bytes = begin(PluginMessage::count);
        appendNumber(bytes, static_cast<std::uint64_t>(controller_->commandsPerPeriod(period)));
        return bytes;
    }

    std::string decide(ByteReader& reader) {
        if (!readObservation(reader, types_, observation_) || reader.rest().size() != memory_.size()) return "";
        memory_ = reader.rest();
        decision_.clear();
        controller_->decide(observation_, memory(), decision_);
        std::string bytes = begin(PluginMessage::decided);
        appendDecision(decision_, bytes);
        return bytes + memory_;
    }

    std::string explain(ByteReader& reader) {
        if (reader.rest().size() != memory_.size()) return "";
        memory_ = reader.rest();
        std::string bytes = begin(PluginMessage::explained);
        appendEntries(explained(*controller_, memory()), bytes);
        return bytes;
    }

    std::span<std::byte> memory() { return std::as_writable_bytes(std::span(memory_)); }

    std::shared_ptr<const PluginController> controller_;
    std::string memory_;
    RecordTypes types_;
    Attention attention_;  ///< before the observation that refers to it
    Observation observation_;
    Decision decision_;
};

/// A plug-in that never returns must not outlive the program.
void endWithTheProgram(int socket) {
    std::thread([socket] {
        pollfd waiting{socket, POLLRDHUP, 0};
        while (::poll(&waiting, 1, -1) <= 0) {
        }
        ::_exit(0);
    }).detach();
}

}  // namespace

void servePlugin(int socket) {
    const rlimit noCore{0, 0};
    ::setrlimit(RLIMIT_CORE, &noCore);
    // Schedulers signal all processes; the program alone says when this one ends.
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_IGN);
    endWithTheProgram(socket);
    const MessageChannel channel(socket);
    PluginServer server;
    std::string message;
    while (channel.receive(message, {}) == MessageChannel::Outcome::done) {
        const std::string answer = server.answer(message);
        if (answer.empty() || channel.send(answer, {}) != MessageChannel::Outcome::done) return;
    }
}

}  // namespace mrose
