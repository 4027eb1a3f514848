#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "recording/mcap_writer.h"
#include "recording/reading_topics.h"
#include "scenario/scenario.h"
#include "simulation/step.h"

namespace mrose {

/// What other programs see of one branch: poses, velocities, commands and contacts ten times a second, what is of note
/// when it happens, what sensors give (ReadingTopics), the scene once. Topics and frames of other branches than the run
/// itself begin with "branch_N/".
class SceneTopics {
public:
    /// Once in a file.
    struct Schemas {
        std::uint16_t transforms = 0, scene = 0, log = 0, bodies = 0, radio = 0;
        ReadingTopics::Schemas readings;
    };
    static Schemas addSchemas(mcap::Writer& writer, const Scenario& scenario);
    /// Those of a branch with other bodies.
    static Schemas addSchemas(mcap::Writer& writer, const Scenario& scenario, const Schemas& others);

    SceneTopics(mcap::Writer& writer, const Schemas& schemas, const Scenario& scenario, std::uint32_t branch);

    /// The scene, and the bodies as they begin.
    void begin(mcap::Writer& writer, const WorldState& state);
    /// One tick.
    void add(mcap::Writer& writer, const WorldState& after, const StepTrace& trace);

private:
    void writeSample(mcap::Writer& writer, const WorldState& state);

    const Scenario& scenario_;
    std::vector<std::string> names_, frames_;
    std::uint16_t transforms_ = 0, scene_ = 0, log_ = 0, bodies_ = 0, contacts_ = 0, radio_ = 0;
    ReadingTopics readings_;
    std::int64_t sampleTicks_ = 1;
    std::vector<ContactReport> pressed_;  ///< since the last sample
    bool showsContacts_ = false;          ///< the last sample had some
};

}  // namespace mrose
