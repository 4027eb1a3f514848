// Whatever a plug-in's process answers, it becomes a decision, or an observation and the like, that comes back from its
// own bytes; or it is refused, and has taken no more memory than a small multiple of its size.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/require.h"
#include "messages/decision_bytes.h"
#include "messages/memory_entry_bytes.h"
#include "messages/observation_bytes.h"

namespace mrose {
namespace {

void requireDecision(std::string_view bytes) {
    ByteReader reader(bytes);
    Decision decision;
    const bool sound = readDecision(reader, decision);
    require(decision.annotations.capacity() + decision.earlier.capacity() + decision.kicks.capacity() +
                decision.messages.capacity() <=
            bytes.size() + 8);
    if (!sound) return;
    std::string again;
    appendDecision(decision, again);
    require(again == bytes.substr(0, bytes.size() - reader.rest().size()));
}

void requireObservation(std::string_view bytes) {
    ByteReader reader(bytes);
    RecordTypes types;
    Observation observation;
    const bool sound = readObservation(reader, types, observation);
    std::size_t records = 0;
    for (const Reading& reading : observation.readings()) records += reading.count;
    require(records + observation.readings().size() <= bytes.size() + 8);
    if (!sound) return;
    std::string again;
    appendObservation(observation, again);
    require(again == bytes.substr(0, bytes.size() - reader.rest().size()));
}

void requireEntries(std::string_view bytes) {
    ByteReader reader(bytes);
    std::vector<MemoryEntry> entries;
    const bool sound = readEntries(reader, entries);
    require(entries.size() <= bytes.size());
    if (!sound) return;
    std::string again;
    appendEntries(entries, again);
    require(again == bytes.substr(0, bytes.size() - reader.rest().size()));
}

void requireAttention(std::string_view bytes) {
    ByteReader reader(bytes);
    Attention attention;
    const bool sound = readAttention(reader, attention);
    require(attention.names.size() <= bytes.size());
    if (!sound) return;
    std::string again;
    appendAttention(attention, again);
    require(again == bytes.substr(0, bytes.size() - reader.rest().size()));
}

}  // namespace
}  // namespace mrose

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    mrose::requireDecision(bytes);
    mrose::requireObservation(bytes);
    mrose::requireEntries(bytes);
    mrose::requireAttention(bytes);
    return 0;
}
