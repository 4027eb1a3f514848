#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace mrose {

/// A socket to another process, over which whole messages go, each with its length in front.
class MessageChannel {
public:
    explicit MessageChannel(int socket) : socket_(socket) {}
    MessageChannel(const MessageChannel&) = delete;
    MessageChannel& operator=(const MessageChannel&) = delete;
    ~MessageChannel();

    static constexpr std::size_t mostBytes = 16 << 20;  ///< of a message

    enum class Outcome { done, closed, late, unsound };
    /// nullopt: as long as it takes.
    using Deadline = std::optional<std::chrono::steady_clock::time_point>;

    Outcome send(std::string_view message, const Deadline& deadline) const;
    /// Unsound: the length is beyond bounds.
    Outcome receive(std::string& message, const Deadline& deadline) const;
    int socket() const { return socket_; }

private:
    Outcome wait(short event, const Deadline& deadline) const;
    Outcome sendAll(std::string_view bytes, const Deadline& deadline) const;
    Outcome receiveAll(char* bytes, std::size_t size, const Deadline& deadline) const;

    int socket_;
};

}  // namespace mrose
