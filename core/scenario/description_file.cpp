#include "scenario/description_file.h"

#include "scenario/description_reader.h"
#include "scenario/environment_file.h"
#include "scenario/sensor_preset.h"
#include "scenario/shape_file.h"

namespace mrose {
namespace {

template <class T>
Expected<Description> described(Expected<T> value) {
    if (!value) return tl::unexpected(value.error());
    return Description(std::move(*value));
}

}  // namespace

Expected<Description> loadDescription(const std::string& name, DescriptionSource& source,
                                      const ScenarioLoading& loading) {
    constexpr std::string_view folders[] = {"resources/scenarios", "resources/environments", "resources/robots",
                                            "resources/sensors", "shapes"};
    DescriptionLibrary library(source);
    const auto file = library.file(name, folders);
    if (!file) return tl::unexpected(file.error());
    const Value& content = (*file)->content;
    const std::string shown = library.shown((*file)->name);
    const auto kind = descriptionKind(content, shown);
    if (!kind) return tl::unexpected(kind.error());
    switch (*kind) {
        case DescriptionKind::shape:
            return described(readShape(content, shown));
        case DescriptionKind::environment:
            return described(readEnvironment(content, shown));
        case DescriptionKind::robot:
            return described(readRobot(*file, library));
        case DescriptionKind::sensor:
            if (const auto preset = readSensorPreset(*file, library); !preset) return tl::unexpected(preset.error());
            return fail(shown, "describes a sensor, which robot files name by `preset`; expected another description");
        case DescriptionKind::experiment:
            return fail(shown, "describes an experiment, which mrose experiment runs; expected another description");
        case DescriptionKind::tuning:
            return fail(shown, "describes a tuning, which mrose tune runs; expected another description");
        case DescriptionKind::settings:
            return fail(shown, "holds settings, for --settings; expected another description");
        case DescriptionKind::scenario:
            break;
    }
    return described(loadScenario((*file)->name, source, loading));
}

}  // namespace mrose
