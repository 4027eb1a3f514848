#include "recording/branch_scenario.h"

#include "io/bytes.h"
#include "io/compression.h"

namespace mrose {
namespace {

constexpr std::uint32_t textsVersion = 1;     // kept as the texts of its descriptions
constexpr std::uint32_t scenarioVersion = 2;  // kept as its value

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
bool readText(ByteReader& reader, const KeptTexts& run, KeptTexts& texts) {
    const std::string name(readLong(reader));
    const auto own = reader.number<std::uint8_t>();
    if (own == 1) return texts.emplace(name, readLong(reader)).second && !reader.failed();
    const auto shared = run.find(name);
    return own == 0 && !reader.failed() && shared != run.end() && texts.insert(*shared).second;
}

std::optional<ScenarioValue> readTexts(ByteReader& reader, const KeptTexts& run) {
    const std::string name(readLong(reader));
    KeptTexts texts;
    for (auto left = reader.number<std::uint64_t>(); left > 0; --left)
        if (!readText(reader, run, texts)) return {};
    if (!reader.done()) return {};
    auto value = scenarioOfTexts(name, texts);
    if (!value) return {};
    return std::move(*value);
}

std::vector<Value::File> filesOf(const ScenarioValue* scenario) {
    return scenario ? scenario->files() : std::vector<Value::File>();
}

}  // namespace

std::string branchScenarioBytes(const BranchScenario& scenario, const ScenarioValue* run) {
    std::string bytes;
    appendNumber(bytes, scenarioVersion);
    appendNumber(bytes, scenario.branch);
    appendNumber(bytes, scenario.layout.tickLength);
    appendNumber(bytes, std::uint64_t{scenario.layout.controllers.size()});
    for (const RecordingHeader::ControllerNeeds& needs : scenario.layout.controllers) {
        appendNumber(bytes, needs.memorySize);
        appendNumber(bytes, needs.commandsPerPeriod);
    }
    bytes += scenario.value->bytes(filesOf(run));
    return compressed(bytes);
}

std::optional<BranchScenario> parseBranchScenario(std::string_view bytes, const ScenarioValue* run,
                                                  const KeptTexts& texts) {
    const std::optional<std::string> content = decompressed(bytes);
    if (!content) return std::nullopt;
    ByteReader reader(*content);
    const auto version = reader.number<std::uint32_t>();
    if (version != scenarioVersion && version != textsVersion) return std::nullopt;
    BranchScenario scenario;
    scenario.branch = reader.number<std::uint32_t>();
    scenario.layout.tickLength = reader.number<Nanoseconds>();
    if (scenario.layout.tickLength <= 0 || !readControllerNeeds(reader, scenario.layout.controllers))
        return std::nullopt;
    auto value = version == textsVersion ? readTexts(reader, texts) : ScenarioValue::parse(reader.rest(), filesOf(run));
    if (!value) return std::nullopt;
    scenario.value = std::make_shared<const ScenarioValue>(std::move(*value));
    return scenario;
}

}  // namespace mrose
