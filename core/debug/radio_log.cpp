#include "debug/radio_log.h"

#include <algorithm>

namespace mrose {
namespace {

template <class T>
void keepNewestOf(std::vector<T>& entries, std::int64_t oldest) {
    std::erase_if(entries, [&](const T& entry) { return entry.tick < oldest; });
    if (entries.size() > RadioLog::most)
        entries.erase(entries.begin(), entries.end() - static_cast<std::ptrdiff_t>(RadioLog::most));
}

}  // namespace

void RadioLog::add(const Scene& scene, const WorldState& after, const StepTrace& trace) {
    const std::int64_t tick = after.tick - 1;
    for (const Transmission& one : trace.transmissions) due.push_back({tick, trace.messages[one.message], one});
    for (const SentMessage& message : after.messages)
        if (message.tick == tick) sent.push_back(message);
    const std::int64_t oldest = after.tick - scene.ticksOf(kept);
    keepNewestOf(sent, oldest);
    keepNewestOf(due, oldest);
}

}  // namespace mrose
