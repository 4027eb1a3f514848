#include "plugin/message_channel.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace mrose {

MessageChannel::~MessageChannel() { ::close(socket_); }

MessageChannel::Outcome MessageChannel::wait(short event, const Deadline& deadline) const {
    for (;;) {
        int milliseconds = -1;
        if (deadline) {
            const auto left = *deadline - std::chrono::steady_clock::now();
            const auto whole = std::chrono::ceil<std::chrono::milliseconds>(left).count();
            milliseconds = static_cast<int>(std::clamp<std::int64_t>(whole, 0, 1 << 30));
        }
        pollfd waiting{socket_, event, 0};
        const int ready = ::poll(&waiting, 1, milliseconds);
        if (ready > 0) return Outcome::done;
        if (ready == 0) return Outcome::late;
        if (errno != EINTR) return Outcome::closed;
    }
}

// Trying comes before waiting: mostly there is nothing to wait for. No signal says that the other end is gone.

MessageChannel::Outcome MessageChannel::sendAll(std::string_view bytes, const Deadline& deadline) const {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        } else if (errno == EAGAIN) {
            if (const Outcome outcome = wait(POLLOUT, deadline); outcome != Outcome::done) return outcome;
        } else if (errno != EINTR) {
            return Outcome::closed;
        }
    }
    return Outcome::done;
}

MessageChannel::Outcome MessageChannel::receiveAll(char* bytes, std::size_t size, const Deadline& deadline) const {
    while (size > 0) {
        const ssize_t got = ::recv(socket_, bytes, size, MSG_DONTWAIT);
        if (got > 0) {
            bytes += got;
            size -= static_cast<std::size_t>(got);
        } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
            return Outcome::closed;
        } else if (errno == EAGAIN) {
            if (const Outcome outcome = wait(POLLIN, deadline); outcome != Outcome::done) return outcome;
        }
    }
    return Outcome::done;
}

MessageChannel::Outcome MessageChannel::send(std::string_view message, const Deadline& deadline) const {
    if (message.size() > mostBytes) return Outcome::unsound;
    std::string framed(sizeof(std::uint32_t), '\0');
    const auto size = static_cast<std::uint32_t>(message.size());
    std::memcpy(framed.data(), &size, sizeof size);
    framed += message;
    return sendAll(framed, deadline);
}

MessageChannel::Outcome MessageChannel::receive(std::string& message, const Deadline& deadline) const {
    std::uint32_t size = 0;
    Outcome outcome = receiveAll(reinterpret_cast<char*>(&size), sizeof size, deadline);
    if (outcome != Outcome::done) return outcome;
    if (size > mostBytes) return Outcome::unsound;
    message.resize(size);
    return receiveAll(message.data(), size, deadline);
}

}  // namespace mrose
