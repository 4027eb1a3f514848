#include "scenario/description_library.h"

#include <vector>

#include "io/toml_text.h"
#include "plugin/network_mapping.h"
#include "scenario/delayed_network.h"
#include "scenario/sensor_preset.h"
#include "scenario/shape_file.h"

namespace mrose {
namespace {

std::string shippedFolder(std::string_view folder) {
    return std::string(shippedPrefix) + std::string(folder) + (folder.empty() ? "" : "/");
}

}  // namespace

Expected<Value::File> DescriptionLibrary::open(const std::string& name, const std::string& reference, Holds holds) {
    if (const auto found = files_.find({name, holds}); found != files_.end()) return found->second;
    auto text = source_.text(name);
    if (!text) return tl::unexpected(text.error());
    if (!*text) return nullptr;
    DescriptionFile file{name, reference, {}};
    if (holds == Holds::tables) {
        auto tables = parseToml(**text, source_.shown(name));
        if (!tables) return tl::unexpected(tables.error());
        file.content = std::move(*tables);
    } else {
        file.content = std::move(**text);
    }
    return files_.emplace(std::pair(name, holds), std::make_shared<const DescriptionFile>(std::move(file)))
        .first->second;
}

Expected<Value::File> DescriptionLibrary::file(const std::string& name, std::span<const std::string_view> folders) {
    if (auto given = open(name, "", Holds::tables); !given || *given) return given;
    std::vector<std::string> places{joinedName(shippedFolder(""), name)};
    for (const std::string_view folder : folders) places.push_back(joinedName(shippedFolder(folder), name));
    std::erase(places, name);  // absolute, or as recordings call it
    Value::File found;
    std::string looked, several;
    for (const std::string& place : places) {
        auto shipped = open(place, "", Holds::tables);
        if (!shipped) return shipped;
        looked += (looked.empty() ? ", nor does " : " or ") + source_.shown(place);
        if (!*shipped) continue;
        several += (several.empty() ? "" : " and ") + place.substr(shippedPrefix.size());
        if (found) return fail(name, "several files of that name ship: " + several + "; expected one of them");
        found = *shipped;
    }
    if (found) return found;
    return fail(source_.shown(name), "does not exist" + looked);
}

Value::File DescriptionLibrary::file(TomlTable& table, std::string_view key, const std::string& from,
                                     std::string_view folder, Holds holds) {
    const Value* const given = table.value(key);
    if (!given) return nullptr;
    if (Value::File file = given->sharedFile()) {
        if (holds == Holds::tables ? file->content.asTable() != nullptr : file->content.asText() != nullptr)
            return file;
        table.reject(key, "holds something else than such a file");
        return nullptr;
    }
    const std::string reference = table.string(key);
    if (table.failed()) return nullptr;
    const std::string beside = joinedName(from, reference);
    const std::string shipped = joinedName(shippedFolder(folder), reference);
    for (const std::string& name : {beside, shipped}) {
        if (name == from) continue;  // a robot file and its shape file may be called the same
        const auto found = open(name, reference, holds);
        if (!found) return table.adopt(found.error()), nullptr;
        if (!*found) continue;
        table.resolve(key, *found);
        return *found;
    }
    table.reject(key, '"' + reference + "\" was not found; expected " + source_.shown(beside) +
                          (beside == shipped ? "" : " or " + source_.shown(shipped)));
    return nullptr;
}

Error DescriptionLibrary::saysWhoNames(Error error, const Value::File& file, const std::string& from,
                                       std::string_view key) const {
    if (error.key == "format" && error.file == shown(file->name))
        error.cause += "; " + shown(from) + " names this file as its " + std::string(key);
    return error;
}

std::shared_ptr<const Shape> DescriptionLibrary::shape(TomlTable& table, std::string_view key,
                                                       const std::string& from) {
    const Value::File file = this->file(table, key, from, "shapes", Holds::tables);
    if (!file) return nullptr;
    std::shared_ptr<const Shape>& shape = shapes_[file];
    if (shape) return shape;
    auto read = readShape(file->content, shown(file->name));
    if (!read) return table.adopt(saysWhoNames(read.error(), file, from, key)), nullptr;
    return shape = std::make_shared<const Shape>(std::move(*read));
}

const MotionNetwork* DescriptionLibrary::network(TomlTable& table, std::string_view key, const std::string& from) {
    const Value::File file = this->file(table, key, from, "nets", Holds::text);
    if (!file) return nullptr;
    if (const auto found = networks_.find(file); found != networks_.end()) return &found->second;
    auto parsed = parseNetwork(*file->content.asText(), shown(file->name));
    if (!parsed) return table.adopt(parsed.error()), nullptr;
    return &networks_.emplace(file, std::move(*parsed)).first->second;
}

std::shared_ptr<const LearnedMotion> DescriptionLibrary::motion(const MotionNetwork& network, Nanoseconds laterV,
                                                                Nanoseconds laterW) {
    std::shared_ptr<const LearnedMotion>& motion = motions_[{&network, laterV, laterW}];
    if (!motion) motion = std::make_shared<const LearnedMotion>(delayed(network, laterV, laterW));
    return motion;
}

std::shared_ptr<const LearnedKicker> DescriptionLibrary::kicker(TomlTable& table, std::string_view key,
                                                                const std::string& from) {
    const Value::File file = this->file(table, key, from, "nets", Holds::text);
    if (!file) return nullptr;
    std::shared_ptr<const LearnedKicker>& kicker = kickers_[file];
    if (kicker) return kicker;
    auto parsed = parseKick(*file->content.asText(), shown(file->name));
    if (!parsed) return table.adopt(parsed.error()), nullptr;
    return kicker = std::make_shared<const LearnedKicker>(std::move(*parsed));
}

std::shared_ptr<const LearnedSensor> DescriptionLibrary::sensor(TomlTable& table, std::string_view key,
                                                                const std::string& from) {
    const Value::File file = this->file(table, key, from, "nets", Holds::text);
    if (!file) return nullptr;
    std::shared_ptr<const LearnedSensor>& sensor = sensors_[file];
    if (sensor) return sensor;
    auto parsed = parseSensor(*file->content.asText(), shown(file->name));
    if (!parsed) return table.adopt(parsed.error()), nullptr;
    return sensor = std::make_shared<const LearnedSensor>(std::move(*parsed));
}

std::shared_ptr<const LearnedMapping> DescriptionLibrary::mapping(TomlTable& table, std::string_view key,
                                                                  const std::string& from) {
    return mapping(table, this->file(table, key, from, "nets", Holds::text));
}

std::shared_ptr<const LearnedMapping> DescriptionLibrary::mapping(TomlTable& table, const Value::File& file) {
    if (!file) return nullptr;
    std::shared_ptr<const LearnedMapping>& mapping = mappings_[file];
    if (!mapping) {
        auto parsed = parseMapping(*file->content.asText(), shown(file->name));
        if (!parsed) return table.adopt(parsed.error()), nullptr;
        mapping = std::make_shared<const NetworkMapping>(std::move(*parsed));
    }
    return mapping;
}

std::shared_ptr<const LearnedMapping> DescriptionLibrary::mapping(TomlTable& table, std::string_view key,
                                                                  const std::string& from,
                                                                  std::initializer_list<const char*> inputs,
                                                                  std::initializer_list<const char*> outputs) {
    const Value::File file = this->file(table, key, from, "nets", Holds::text);
    std::shared_ptr<const LearnedMapping> found = mapping(table, file);
    if (!found) return nullptr;
    const std::string cause = mismatch(*found, inputs, outputs);
    if (!cause.empty()) return table.reject(key, shown(file->name) + ' ' + cause), nullptr;
    return found;
}

const Value* DescriptionLibrary::sensorPreset(TomlTable& table, std::string_view key, const std::string& from) {
    const Value::File file = this->file(table, key, from, "resources/sensors", Holds::tables);
    if (!file) return nullptr;
    Preset& preset = presets_[file];
    if (!preset.file) {
        auto checked = readSensorPreset(file, *this);
        if (!checked) return table.adopt(checked.error()), nullptr;
        preset.keys = presetKeys(*checked);
        preset.file =
            std::make_shared<const DescriptionFile>(DescriptionFile{file->name, file->reference, std::move(*checked)});
    }
    table.resolve(key, preset.file);
    return &preset.keys;
}

SensorSources DescriptionLibrary::sensorSources(const std::string& from, std::shared_ptr<const Shape> shape) {
    return {[this, from](TomlTable& table, std::string_view key) { return sensor(table, key, from); },
            [this, from](TomlTable& table, std::string_view key) { return sensorPreset(table, key, from); },
            std::move(shape)};
}

}  // namespace mrose
