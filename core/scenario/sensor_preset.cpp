#include "scenario/sensor_preset.h"

#include "scenario/description_reader.h"
#include "sensing/sensor_kinds.h"

namespace mrose {

Expected<Value> readSensorPreset(const Value::File& file, DescriptionLibrary& library) {
    TomlTable root = openDescription(file->content, library.shown(file->name), DescriptionKind::sensor);
    SensorTraits traits;
    traits.name = "sensor";
    name(root, "name");
    root.string("source");
    traits.period = durationOr(root, "period_s", 0, {0.001, 10});
    readSensor(root, traits, library.sensorSources(file->name));
    root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    return root.resolved();
}

Value presetKeys(Value content) {
    for (const char* const ofFile : {"format", "version", "name", "source"}) content = content.without(ofFile);
    return content;
}

}  // namespace mrose
