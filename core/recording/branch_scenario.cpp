#include "recording/branch_scenario.h"

#include "io/bytes.h"
#include "recording/compression.h"

namespace mrose {
namespace {

constexpr std::uint32_t scenarioVersion = 1;

bool readControllerNeeds(ByteReader& reader, std::vector<RecordingHeader::ControllerNeeds>& controllers) {
    const auto count = reader.number<std::uint64_t>();
    if (count > reader.rest().size() / sizeof(RecordingHeader::ControllerNeeds)) return false;
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto memorySize = reader.number<std::uint64_t>();
        controllers.push_back({memorySize, reader.number<std::uint64_t>()});
    }
    return true;
}

/// One text under its name; whether it is sound.
bool readDescription(ByteReader& reader, const Descriptions& run, std::map<std::string, std::string>& texts) {
    const std::string name(readLong(reader));
    const auto own = reader.number<std::uint8_t>();
    if (own == 1) return texts.emplace(name, readLong(reader)).second && !reader.failed();
    const auto shared = run.texts.find(name);
    return own == 0 && !reader.failed() && shared != run.texts.end() && texts.insert(*shared).second;
}

}  // namespace

std::string branchScenarioBytes(const BranchScenario& scenario, const Descriptions& run) {
    std::string bytes;
    appendNumber(bytes, scenarioVersion);
    appendNumber(bytes, scenario.branch);
    appendNumber(bytes, scenario.layout.tickLength);
    appendNumber(bytes, std::uint64_t{scenario.layout.controllers.size()});
    for (const RecordingHeader::ControllerNeeds& needs : scenario.layout.controllers) {
        appendNumber(bytes, needs.memorySize);
        appendNumber(bytes, needs.commandsPerPeriod);
    }
    appendLong(bytes, scenario.descriptions.scenario);
    appendNumber(bytes, std::uint64_t{scenario.descriptions.texts.size()});
    for (const auto& [name, text] : scenario.descriptions.texts) {
        const auto shared = run.texts.find(name);
        const bool own = shared == run.texts.end() || shared->second != text;
        appendLong(bytes, name);
        appendNumber(bytes, static_cast<std::uint8_t>(own));
        if (own) appendLong(bytes, text);
    }
    return compressed(bytes);
}

std::optional<BranchScenario> parseBranchScenario(std::string_view bytes, const Descriptions& run) {
    const std::optional<std::string> content = decompressed(bytes);
    if (!content) return std::nullopt;
    ByteReader reader(*content);
    if (reader.number<std::uint32_t>() != scenarioVersion) return std::nullopt;
    BranchScenario scenario;
    scenario.branch = reader.number<std::uint32_t>();
    scenario.layout.tickLength = reader.number<Nanoseconds>();
    if (scenario.layout.tickLength <= 0 || !readControllerNeeds(reader, scenario.layout.controllers))
        return std::nullopt;
    scenario.descriptions.scenario = readLong(reader);
    for (auto left = reader.number<std::uint64_t>(); left > 0; --left)
        if (!readDescription(reader, run, scenario.descriptions.texts)) return std::nullopt;
    if (!reader.done()) return std::nullopt;
    return scenario;
}

}  // namespace mrose
