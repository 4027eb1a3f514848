#include "recording/recording.h"

#include <algorithm>
#include <charconv>
#include <set>

#include "io/file.h"
#include "recording/block_bytes.h"
#include "recording/branch_scenario.h"
#include "recording/mcap_reader.h"
#include "recording/recording_format.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

const mcap::Strings* metadataOf(const mcap::Content& content, std::string_view name) {
    for (const auto& [key, strings] : content.metadata)
        if (key == name) return &strings;
    return nullptr;
}

std::string valueOf(const mcap::Strings& strings, const char* key) {
    const auto found = strings.find(key);
    return found == strings.end() ? "" : found->second;
}

template <class Integer>
bool parseInteger(std::string_view text, Integer& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

/// Of "memory size, commands per period" by the robots' numbers.
bool readControllers(const mcap::Strings& strings, std::vector<RecordingHeader::ControllerNeeds>& controllers) {
    for (std::size_t i = 0; i < strings.size(); ++i) {
        const std::string text = valueOf(strings, std::to_string(i).c_str());
        const std::size_t gap = text.find(' ');
        RecordingHeader::ControllerNeeds needs;
        if (gap == std::string::npos || !parseInteger(std::string_view(text).substr(0, gap), needs.memorySize) ||
            !parseInteger(std::string_view(text).substr(gap + 1), needs.commandsPerPeriod))
            return false;
        controllers.push_back(needs);
    }
    return true;
}

/// Scenarios have ticks of 0.1 s at the most.
constexpr Nanoseconds longestTick = nanosecondsPerSecond;

/// Why controllers that ask for so much have not been those of a state; "" where they may.
std::string wrongNeeds(const std::vector<RecordingHeader::ControllerNeeds>& controllers, const WorldState& state) {
    if (controllers.size() != state.robots.size())
        return "lists " + std::to_string(controllers.size()) + " robots; its first state has " +
               std::to_string(state.robots.size());
    const std::string held = "; its first state holds " + std::to_string(state.memory.size()) + " for all";
    std::uint64_t memory = 0;
    for (std::size_t i = 0; i < controllers.size(); ++i) {
        const std::uint64_t size = controllers[i].memorySize;
        if (size > state.memory.size())
            return "asks for " + std::to_string(size) + " bytes of memory for robot " + std::to_string(i + 1) + held;
        memory += paddedMemory(size);
    }
    return memory == state.memory.size() ? "" : "asks for " + std::to_string(memory) + " bytes of memory" + held;
}

/// How much memory descriptions take, roughly; what they share with others is counted once.
class Weight {
public:
    std::size_t of(const ScenarioValue& scenario) { return of(scenario.content()); }

private:
    std::size_t of(const Value& value) {
        std::size_t size = sizeof value;
        if (const Value::Array* const array = value.asArray(); array && known_.insert(array).second)
            for (const Value& element : *array) size += of(element);
        if (const Value::Table* const table = value.asTable(); table && known_.insert(table).second)
            for (const auto& [key, element] : *table) size += sizeof(std::string) + key.size() + of(element);
        if (const DescriptionFile* const file = value.asFile(); file && known_.insert(file).second)
            size += sizeof *file + of(file->content);
        if (const std::string* const text = value.asText()) size += text->size();
        return size;
    }

    std::set<const void*> known_;
};

class RecordingReader {
public:
    RecordingReader(const mcap::Content& content, std::string name, std::uint64_t most)
        : content_(content), name_(std::move(name)), most_(most) {}

    Expected<Recording> read() {
        recording_.damage = content_.damage;
        recording_.endless = content_.endless;
        if (const auto header = readHeader(); !header) return tl::unexpected(header.error());
        for (const mcap::Attachment& attachment : content_.attachments) {
            const bool sound = readAttachment(attachment);
            if (sound && unpacked_ <= most_) continue;
            recording_.damage.push_back(
                "from tick " + std::to_string(lastTick()) + " on it cannot be used: " +
                (sound ? "unpacked it takes more than " + std::to_string(most_ >> 20) + " MB"
                       : "what lies at byte " + std::to_string(attachment.offset) + " does not go on there"));
            break;
        }
        if (!wrongNeeds_.empty()) return fail(name_, wrongNeeds_, 0, format::controllers);
        if (recording_.branches.empty()) return withoutBeginning();
        readShown();
        return std::move(recording_);
    }

private:
    tl::unexpected<Error> withoutBeginning() const {
        return fail(name_, "is a recording without a beginning" + damageText());
    }
    std::string damageText() const {
        return recording_.damage.empty() ? std::string() : ": " + recording_.damage.front();
    }
    std::int64_t lastTick() const {
        return recording_.branches.empty() ? 0 : recording_.branches.back().timeline.last();
    }

    Expected<void> readHeader() {
        const mcap::Strings* const run = metadataOf(content_, format::run);
        if (run == nullptr) return fail(name_, "is no recording of mrose" + damageText());
        if (const std::string found = valueOf(*run, format::formatKey);
            found != format::version && found != format::textsVersion)
            return fail(name_, "is a recording of format " + found + "; expected " + format::version, 0,
                        format::formatKey);
        RecordingHeader& header = recording_.header;
        header.origin = {valueOf(*run, format::versionKey), valueOf(*run, format::commitKey),
                         valueOf(*run, format::compilerKey), valueOf(*run, format::buildTypeKey), 1};
        if (const std::string step = valueOf(*run, format::stepKey);
            !step.empty() && !parseInteger(step, header.origin.step))
            return fail(name_, "expected an integer", 0, format::stepKey);
        header.name = valueOf(*run, format::scenarioKey);
        header.commandLine = valueOf(*run, format::commandLineKey);
        if (!parseInteger(valueOf(*run, format::seedKey), header.seed))
            return fail(name_, "expected an integer", 0, format::seedKey);
        if (!parseInteger(valueOf(*run, format::tickLengthKey), header.tickLength) || !soundTick(header.tickLength))
            return fail(name_, "expected an integer of 1 to " + std::to_string(longestTick), 0, format::tickLengthKey);
        const mcap::Strings* const controllers = metadataOf(content_, format::controllers);
        if (controllers == nullptr) return withoutBeginning();
        if (!readControllers(*controllers, header.controllers))
            return fail(name_, "expected two integers for each robot", 0, format::controllers);
        return {};
    }

    /// Only what can be shown: of a recording that was cut off it may lie beyond the end.
    void readShown() {
        const mcap::Strings* const shown = metadataOf(content_, format::shown);
        ShownPlace place;
        if (shown != nullptr && parseInteger(valueOf(*shown, format::branchKey), place.branch) &&
            parseInteger(valueOf(*shown, format::tickKey), place.tick) && place.branch < recording_.branches.size() &&
            place.tick <= recording_.branches[place.branch].timeline.last())
            recording_.shown = place;
    }

    /// Whether it could be used.
    bool readAttachment(const mcap::Attachment& attachment) {
        if (attachment.name.starts_with(format::descriptionPrefix)) {
            const std::string_view name = attachment.name.substr(std::string_view(format::descriptionPrefix).size());
            texts_.emplace(name, attachment.data);
        } else if (attachment.name.starts_with(format::scenarioPrefix)) {
            scenario_ = parseBranchScenario(attachment.data, recording_.header.value.get(), texts_);
            if (!scenario_ || scenario_->branch != recording_.branches.size() ||
                !soundTick(scenario_->layout.tickLength))
                return false;
            unpacked_ += weight_.of(*scenario_->value);
            if (recording_.branches.empty()) recording_.header.value = scenario_->value;
        } else if (attachment.name.starts_with(format::branchPrefix)) {
            return addBranch(parseBranch(attachment.data));
        } else if (attachment.name.starts_with(format::blockPrefix)) {
            return addBlock(parseBlock(attachment.data));
        }
        return true;
    }

    static bool soundTick(Nanoseconds length) { return length > 0 && length <= longestTick; }
    /// Whether a branch's clock goes so far.
    static bool soundTime(const Recording::Layout& layout, std::int64_t tick) {
        return tick <= latestTime / layout.tickLength;
    }

    bool addBranch(std::optional<BranchStart> start) {
        std::vector<Branch>& branches = recording_.branches;
        if (!start || start->branch != branches.size()) return false;
        if (branches.empty() ? start->parent != 0 : start->parent >= branches.size()) return false;
        if (branches.empty() && !texts_.empty()) readTexts();
        const std::uint32_t parent = start->parent;
        if (!addLayout(parent, start->block)) return false;
        const std::int64_t tick = start->block.first;
        unpacked_ += start->block.size() + start->name.size();
        branches.push_back({parent, tick, std::move(start->name), Timeline(std::move(start->block))});
        if (branches.size() > 1)
            branches.back().value = scenario_ ? std::move(scenario_->value) : branches[parent].value;
        scenario_.reset();
        return true;
    }

    /// Of a recording from before scenarios were values.
    void readTexts() {
        const std::string name = valueOf(*metadataOf(content_, format::run), format::scenarioFileKey);
        auto value = scenarioOfTexts(name, texts_);
        if (value)
            recording_.header.value = std::make_shared<const ScenarioValue>(std::move(*value));
        else
            recording_.header.unknown = value.error();
    }

    /// Of the scenario of the branch that begins with `block`: its own, or that of its parent. Whether it fits.
    bool addLayout(std::uint32_t parent, const TimelineBlock& block) {
        const bool first = recording_.layouts.empty();
        Recording::Layout layout = first
                                       ? Recording::Layout{recording_.header.tickLength, recording_.header.controllers}
                                   : scenario_ ? std::move(scenario_->layout)
                                               : recording_.layouts[parent];
        const Expected<WorldState> state = parseState(block.keyframe, name_);
        if (!state) return false;
        const std::string wrong = wrongNeeds(layout.controllers, *state);
        if (first) wrongNeeds_ = wrong;
        if (!wrong.empty() || !soundTime(layout, block.first)) return false;
        recording_.layouts.push_back(std::move(layout));
        return true;
    }

    bool addBlock(std::optional<ReadBlock> read) {
        if (!read || read->branch >= recording_.branches.size()) return false;
        if (!soundTime(recording_.layouts[read->branch], read->block.last())) return false;
        unpacked_ += read->block.size();
        return recording_.branches[read->branch].timeline.append(std::move(read->block));
    }

    const mcap::Content& content_;
    std::string name_;
    std::uint64_t most_, unpacked_ = 0;  ///< bytes
    Recording recording_;
    KeptTexts texts_;                         ///< of an old recording
    std::optional<BranchScenario> scenario_;  ///< of the branch that comes next
    std::string wrongNeeds_;                  ///< of the header's controllers
    Weight weight_;
};

}  // namespace

Expected<Recording> parseRecording(std::string_view bytes, const std::string& name, std::uint64_t most) {
    const Expected<mcap::Content> content = mcap::parse(bytes, name);
    if (!content) return tl::unexpected(content.error());
    return RecordingReader(*content, name, most).read();
}

Expected<Recording> openRecording(const std::filesystem::path& path) {
    const Expected<std::string> bytes = readFile(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return parseRecording(*bytes, path.string());
}

Expected<ScenarioParts> recordedScenario(const Recording& recording, std::uint32_t branch,
                                         const PluginLoader& plugins) {
    const ScenarioValuePointer& value = recording.valueOf(branch);
    if (!value && recording.header.unknown) return tl::unexpected(*recording.header.unknown);
    if (!value) return fail("", "the recording does not hold its scenario");
    auto loaded = loadScenario(*value, {plugins});
    if (!loaded) return tl::unexpected(loaded.error());
    const auto& needs = recording.layouts[branch].controllers;
    std::vector<std::shared_ptr<const Controller>>& controllers = loaded->parts.controllers;
    for (std::size_t i = 0; !plugins && i < std::min(controllers.size(), needs.size()); ++i)
        controllers[i] = std::make_shared<const RecordedController>(needs[i]);
    return std::move(loaded->parts);
}

}  // namespace mrose
