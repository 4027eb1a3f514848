#pragma once

#include <filesystem>

#include <gtest/gtest.h>

#include "recording/match.h"
#include "recording/recording.h"
#include "recording/recording_writer.h"
#include "support/temporary_folder.h"

namespace mrose {

/// A run of a match, a branch of it, and a file of both.
class RecordingFile : public testing::Test {
protected:
    static constexpr std::int64_t ticks = 230, branchTick = 90, branchTicks = 60;

    /// Records the run, flushed at some ticks, and the branch.
    std::filesystem::path record(const RecordingWriter::Options& options = {true, 40});
    static WorldState pushed(WorldState state);
    /// Every tick of the timeline is reached as it was.
    void expectStates(const Timeline& timeline, const StraightRun& straight) const;

    TemporaryFolder folder;
    Scenario scenario{matchParts()};
    StraightRun run = runMatch(scenario, scenario.initialState(), ticks);
    StraightRun branchRun = runMatch(scenario, pushed(run.states[branchTick]), branchTicks);
    ScenarioValuePointer value = valueOf("soccer.toml", 1);

    /// Of a scenario that names a file of odd name and content.
    static ScenarioValuePointer valueOf(const std::string& name, std::int64_t seed) {
        const Value odd = std::make_shared<const DescriptionFile>(
            DescriptionFile{"shapes/ball \"x\".toml", "ball", std::string("\0\n", 2)});
        return std::make_shared<const ScenarioValue>(name, Value::Table{{"seed", seed}, {"shape", odd}});
    }
};

}  // namespace mrose
