#include "recording/scene_topics.h"

#include <algorithm>

#include "recording/body_names.h"
#include "recording/message_schemas.h"
#include "recording/scene_messages.h"
#include "recording/state_messages.h"

namespace mrose {
namespace {

constexpr Nanoseconds samplePeriod = nanosecondsPerSecond / 10;

}  // namespace

SceneTopics::Schemas SceneTopics::addSchemas(mcap::Writer& writer, const Scenario& scenario) {
    const std::vector<std::string> names = bodyNames(scenario.scene());
    const std::span<const std::string> all(names);
    const std::size_t robots = scenario.scene().robots.size();
    const auto add = [&](const char* name, const std::string& text) {
        return writer.addSchema(name, "jsonschema", text);
    };
    return {add("foxglove.FrameTransforms", frameTransformsSchema()),
            add("foxglove.SceneUpdate", sceneUpdateSchema()),
            add("foxglove.Log", logSchema()),
            add("mrose.Robots", robotsSchema(all.first(robots))),
            add("mrose.Objects", objectsSchema(all.subspan(robots))),
            add("mrose.Contacts", contactsSchema())};
}

SceneTopics::SceneTopics(mcap::Writer& writer, const Schemas& schemas, const Scenario& scenario, std::uint32_t branch)
    : scenario_(scenario), names_(bodyNames(scenario.scene())), frames_(names_) {
    const std::string prefix = branch == 0 ? "" : "branch_" + std::to_string(branch) + '/';
    for (std::string& frame : frames_) frame = prefix + frame;
    const auto add = [&](std::uint16_t schema, const char* topic) {
        return writer.addChannel(schema, '/' + prefix + topic, "json");
    };
    transforms_ = add(schemas.transforms, "tf");
    scene_ = add(schemas.scene, "scene");
    robots_ = add(schemas.robots, "robots");
    objects_ = add(schemas.objects, "objects");
    contacts_ = add(schemas.contacts, "contacts");
    contactMarks_ = add(schemas.scene, "contact_marks");
    log_ = add(schemas.log, "log");
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
    pressed_.insert(pressed_.end(), trace.contacts.begin(), trace.contacts.end());
    if (after.tick % sampleTicks_ == 0) writeSample(writer, after);
}

void SceneTopics::writeSample(mcap::Writer& writer, const WorldState& state) {
    const Nanoseconds time = scenario_.scene().timeOf(state.tick);
    writer.addMessage(transforms_, time, transformsMessage(state, frames_, time));
    writer.addMessage(robots_, time, robotsMessage(scenario_, state, names_));
    if (!state.objects.empty()) writer.addMessage(objects_, time, objectsMessage(state, names_));
    writeContacts(writer, time);
}

void SceneTopics::writeContacts(mcap::Writer& writer, Nanoseconds time) {
    if (!pressed_.empty() || showsContacts_) {
        const std::vector<SummedContact> contacts = summedContacts(pressed_);
        writer.addMessage(contacts_, time, contactsMessage(scenario_, contacts, names_));
        writer.addMessage(contactMarks_, time, contactMarksMessage(contacts, time));
    }
    showsContacts_ = !pressed_.empty();
    pressed_.clear();
}

}  // namespace mrose
