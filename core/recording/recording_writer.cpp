#include "recording/recording_writer.h"

#include <cassert>

#include "recording/block_bytes.h"
#include "recording/branch_scenario.h"
#include "recording/recording_format.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

std::vector<RecordingHeader::ControllerNeeds> needsOf(const Scenario& scenario) {
    std::vector<RecordingHeader::ControllerNeeds> needs;
    for (std::size_t i = 0; i < scenario.scene().robots.size(); ++i)
        needs.push_back({scenario.controller(i).memorySize(),
                         scenario.controller(i).commandsPerPeriod(scenario.scene().modelOf(i).period())});
    return needs;
}

/// Bytes of messages: with so many a flush ends the chunk (smaller ones are compressed badly), and with so many it is
/// ended even before a keyframe is due.
constexpr std::size_t worthAChunk = std::size_t{1} << 17, mostPending = std::size_t{1} << 20;

}  // namespace

Expected<RecordingWriter> RecordingWriter::create(const std::filesystem::path& path, const Scenario& scenario,
                                                  const WorldState& initial, const ScenarioValuePointer& value,
                                                  const std::string& commandLine, const Options& options) {
    Expected<mcap::Writer> mcap = mcap::Writer::create(path, options.overwrite, "mrose " + options.origin.version);
    if (!mcap) return tl::unexpected(mcap.error());
    RecordingWriter writer(std::move(*mcap), scenario, value, options.keyframeInterval);
    writer.writeHeader({value,
                        {},
                        commandLine,
                        options.origin,
                        scenario.parts().name,
                        initial.seed,
                        scenario.scene().tickLength,
                        needsOf(scenario)});
    writer.startBranch(0, initial, options.name, scenario, writer.schemas_);
    writer.flush();
    if (!writer.state()) {
        // No recording yet: it must not stand in the way of the next try.
        writer.mcap_.discard();
        return tl::unexpected(writer.state().error());
    }
    return writer;
}

void RecordingWriter::writeHeader(const RecordingHeader& header) {
    const Origin& origin = header.origin;
    mcap_.addMetadata(format::run, {{format::formatKey, format::version},
                                    {format::versionKey, origin.version},
                                    {format::commitKey, origin.commit},
                                    {format::compilerKey, origin.compiler},
                                    {format::buildTypeKey, origin.buildType},
                                    {format::stepKey, std::to_string(origin.step)},
                                    {format::scenarioKey, header.name},
                                    {format::scenarioFileKey, header.value ? header.value->name() : ""},
                                    {format::seedKey, std::to_string(header.seed)},
                                    {format::tickLengthKey, std::to_string(header.tickLength)},
                                    {format::commandLineKey, header.commandLine}});
    mcap::Strings controllers;
    for (std::size_t i = 0; i < header.controllers.size(); ++i)
        controllers[std::to_string(i)] = std::to_string(header.controllers[i].memorySize) + ' ' +
                                         std::to_string(header.controllers[i].commandsPerPeriod);
    mcap_.addMetadata(format::controllers, controllers);
    if (header.value)
        mcap_.addAttachment(format::scenarioPrefix + std::string("0"), format::blockType, 0,
                            branchScenarioBytes({0, {header.tickLength, header.controllers}, header.value}, nullptr));
}

void RecordingWriter::keepShown(const ShownPlace& place) {
    if (!state()) return;
    mcap_.addMetadata(format::shown, {{format::branchKey, std::to_string(place.branch)},
                                      {format::tickKey, std::to_string(place.tick)}});
}

void RecordingWriter::startBranch(std::uint32_t parent, const WorldState& state, const std::string& name,
                                  const Scenario& scenario, const SceneTopics::Schemas& schemas) {
    const auto branch = static_cast<std::uint32_t>(branches_.size());
    const Nanoseconds time = scenario.scene().timeOf(state.tick);
    mcap_.addAttachment(format::branchPrefix + std::to_string(branch), format::blockType, time,
                        branchBytes({branch, parent, name, {state.tick, stateBytes(state), {}, {}}}));
    branches_.push_back({&scenario,
                         schemas,
                         {state.tick, {}, {}, {}},
                         state.tick,
                         keyframeInterval_ > 0 ? keyframeInterval_ : usualKeyframeInterval(state),
                         SceneTopics(mcap_, schemas, scenario, branch)});
    branches_.back().topics.begin(mcap_, state);
}

std::uint32_t RecordingWriter::beginBranch(std::uint32_t parent, const WorldState& state, const std::string& name) {
    assert(parent < branches_.size());
    // What the branch departs from lies before it in the file.
    flush();
    startBranch(parent, state, name, *branches_[parent].scenario, branches_[parent].schemas);
    return static_cast<std::uint32_t>(branches_.size() - 1);
}

std::uint32_t RecordingWriter::beginBranch(std::uint32_t parent, const WorldState& state, const std::string& name,
                                           const Scenario& scenario, const ScenarioValuePointer& value) {
    assert(parent < branches_.size());
    flush();
    const auto branch = static_cast<std::uint32_t>(branches_.size());
    const BranchScenario own{branch, {scenario.scene().tickLength, needsOf(scenario)}, value};
    mcap_.addAttachment(format::scenarioPrefix + std::to_string(branch), format::blockType,
                        scenario.scene().timeOf(state.tick), branchScenarioBytes(own, run_.get()));
    startBranch(parent, state, name, scenario, SceneTopics::addSchemas(mcap_, scenario, schemas_));
    return branch;
}

void RecordingWriter::add(const WorldState& after, const StepTrace& trace, std::uint32_t branch) {
    if (!state()) return;
    OpenBranch& open = branches_[branch];
    assert(after.tick == open.block.last() + 1);
    open.block.add(hashOf(after), trace);
    open.topics.add(mcap_, after, trace);
    const bool keyframe = after.tick - open.lastKeyframe >= open.keyframeEvery;
    if (!keyframe && mcap_.pendingBytes() < mostPending) return;
    writeBlock(branch);
    mcap_.endChunk();
    if (!keyframe) return;
    open.block.keyframe = stateBytes(after);
    open.lastKeyframe = after.tick;
}

void RecordingWriter::show(const WorldState& after, const StepTrace& trace, std::uint32_t branch) {
    branches_[branch].topics.add(mcap_, after, trace);
    if (mcap_.pendingBytes() >= mostPending) mcap_.endChunk();
}

void RecordingWriter::add(const TimelineBlock& kept, std::uint32_t branch) {
    OpenBranch& open = branches_[branch];
    assert(open.block.hashes.empty() && open.block.last() == kept.first);
    const bool begins = open.lastKeyframe == kept.first && open.block.keyframe.empty();
    open.block = kept;
    if (begins) open.block.keyframe.clear();  // it lies with the branch's beginning
    writeBlock(branch);
    if (!kept.keyframe.empty()) open.lastKeyframe = kept.first;
    if (mcap_.pendingBytes() >= worthAChunk) mcap_.endChunk();
}

void RecordingWriter::keep(const WorldState& state, std::uint32_t branch) {
    OpenBranch& open = branches_[branch];
    assert(state.tick == open.block.last());
    writeBlock(branch);
    if (open.lastKeyframe == state.tick) return;
    open.block.keyframe = stateBytes(state);
    open.lastKeyframe = state.tick;
}

void RecordingWriter::writeBlock(std::uint32_t branch) {
    const Scene& scene = branches_[branch].scenario->scene();
    TimelineBlock& block = branches_[branch].block;
    if (block.hashes.empty() && block.keyframe.empty()) return;
    mcap_.addAttachment(format::blockPrefix + std::to_string(branch) + '/' + std::to_string(block.first),
                        format::blockType, scene.timeOf(block.first), blockBytes(block, branch));
    block = {block.last(), {}, {}, {}};
}

void RecordingWriter::flush() {
    for (std::uint32_t i = 0; i < branches_.size(); ++i) writeBlock(i);
    if (mcap_.pendingBytes() >= worthAChunk) mcap_.endChunk();
    mcap_.sync();
}

Expected<void> RecordingWriter::close() {
    for (std::uint32_t i = 0; i < branches_.size(); ++i) writeBlock(i);
    return mcap_.close();
}

}  // namespace mrose
