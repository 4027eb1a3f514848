#include "recording/scene_topics.h"

#include <algorithm>

#include "recording/body_names.h"
#include "recording/message_schemas.h"
#include "recording/scene_messages.h"
#include "recording/state_messages.h"

namespace mrose {
namespace {

constexpr Nanoseconds samplePeriod = nanosecondsPerSecond / 10;

std::string prefixOf(std::uint32_t branch) { return branch == 0 ? "" : "branch_" + std::to_string(branch) + '/'; }

std::vector<std::string> framesOf(const Scenario& scenario, std::uint32_t branch) {
    std::vector<std::string> frames = bodyNames(scenario.scene());
    for (std::string& frame : frames) frame = prefixOf(branch) + frame;
    return frames;
}

}  // namespace

SceneTopics::Schemas SceneTopics::addSchemas(mcap::Writer& writer, const Scenario& scenario) {
    const auto add = [&](const char* name, const std::string& text) {
        return writer.addSchema(name, "jsonschema", text);
    };
    Schemas schemas;
    schemas.transforms = add("foxglove.FrameTransforms", frameTransformsSchema());
    schemas.scene = add("foxglove.SceneUpdate", sceneUpdateSchema());
    schemas.log = add("foxglove.Log", logSchema());
    schemas.radio = add("mrose.Radio", radioSchema());
    schemas.readings = ReadingTopics::addSchemas(writer);
    return addSchemas(writer, scenario, schemas);
}

SceneTopics::Schemas SceneTopics::addSchemas(mcap::Writer& writer, const Scenario& scenario, const Schemas& others) {
    const std::vector<std::string> names = bodyNames(scenario.scene());
    const std::span<const std::string> all(names);
    const std::size_t robots = scenario.scene().robots.size();
    Schemas schemas = others;
    schemas.bodies =
        writer.addSchema("mrose.Bodies", "jsonschema", bodiesSchema(all.first(robots), all.subspan(robots)));
    return schemas;
}

SceneTopics::SceneTopics(mcap::Writer& writer, const Schemas& schemas, const Scenario& scenario, std::uint32_t branch)
    : scenario_(scenario),
      names_(bodyNames(scenario.scene())),
      frames_(framesOf(scenario, branch)),
      readings_(writer, schemas.readings, scenario, frames_) {
    const auto add = [&](std::uint16_t schema, const char* topic) {
        return writer.addChannel(schema, '/' + prefixOf(branch) + topic, "json");
    };
    transforms_ = add(schemas.transforms, "tf");
    scene_ = add(schemas.scene, "scene");
    bodies_ = add(schemas.bodies, "bodies");
    contacts_ = add(schemas.scene, "contacts");
    log_ = add(schemas.log, "log");
    radio_ = add(schemas.radio, "radio");
    sampleTicks_ = std::max<std::int64_t>(samplePeriod / scenario.scene().tickLength, 1);
}

void SceneTopics::begin(mcap::Writer& writer, const WorldState& state) {
    const Nanoseconds time = scenario_.scene().timeOf(state.tick);
    writer.addMessage(scene_, time, sceneMessage(scenario_, frames_, time));
    showsContacts_ = true;
    writeSample(writer, state);
}

void SceneTopics::add(mcap::Writer& writer, const WorldState& after, const StepTrace& trace) {
    // What happened in a tick is of its end.
    const Nanoseconds time = scenario_.scene().timeOf(after.tick);
    for (const std::string& message : logMessages(scenario_, trace, names_, time))
        writer.addMessage(log_, time, message);
    if (const std::string message = radioMessage(scenario_.scene(), after, trace, names_); !message.empty())
        writer.addMessage(radio_, time, message);
    readings_.add(writer, trace, time);
    pressed_.insert(pressed_.end(), trace.contacts.begin(), trace.contacts.end());
    if (after.tick % sampleTicks_ == 0) writeSample(writer, after);
}

void SceneTopics::writeSample(mcap::Writer& writer, const WorldState& state) {
    const Nanoseconds time = scenario_.scene().timeOf(state.tick);
    const std::vector<SummedContact> contacts = summedContacts(std::move(pressed_));
    pressed_.clear();
    writer.addMessage(transforms_, time, transformsMessage(state, frames_, time));
    writer.addMessage(bodies_, time, bodiesMessage(scenario_, state, contacts, names_));
    // The marks of contacts that are over are taken away once.
    if (!contacts.empty() || showsContacts_)
        writer.addMessage(contacts_, time, contactsMessage(scenario_, contacts, names_, time));
    showsContacts_ = !contacts.empty();
}

}  // namespace mrose
