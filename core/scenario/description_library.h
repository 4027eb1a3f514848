#pragma once

#include <initializer_list>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "control/learned_mapping.h"
#include "geometry/shape.h"
#include "io/error.h"
#include "io/toml_table.h"
#include "io/value.h"
#include "manipulation/learned_kicker.h"
#include "motion/learned_model.h"
#include "perception/learned_sensor.h"
#include "scenario/description_source.h"
#include "sensing/sensor_sources.h"

namespace mrose {

/// Reads each description file once and keeps what was read.
class DescriptionLibrary {
public:
    explicit DescriptionLibrary(DescriptionSource& source) : source_(source) {}

    /// What a file holds for us: the tables of a description, or a text.
    enum class Holds { tables, text };
    /// The file that `table` of the file `from` names by `key`: the one that stands there already, otherwise one seen
    /// from that file's folder, otherwise of those that ship in `folder` ("shapes"); never `from` itself. The table
    /// records what it resolves to. Where there is none, the table remembers the error.
    Value::File file(TomlTable& table, std::string_view key, const std::string& from, std::string_view folder,
                     Holds holds);
    /// The description of exactly that name, otherwise the one of that name that ships, seen from the folder of all
    /// that does or from one of `folders`. Error: there is none, with all places looked at; or several ship.
    Expected<Value::File> file(const std::string& name, std::span<const std::string_view> folders);

    /// Shapes and networks are shared by all that name them. Errors of these files become the table's.
    std::shared_ptr<const Shape> shape(TomlTable& table, std::string_view key, const std::string& from);
    const MotionNetwork* network(TomlTable& table, std::string_view key, const std::string& from);
    /// One of these networks made ready for use, once for each dead time: that of the network, so much later.
    std::shared_ptr<const LearnedMotion> motion(const MotionNetwork& network, Nanoseconds laterV, Nanoseconds laterW);
    std::shared_ptr<const LearnedKicker> kicker(TomlTable& table, std::string_view key, const std::string& from);
    std::shared_ptr<const LearnedSensor> sensor(TomlTable& table, std::string_view key, const std::string& from);
    /// The network of a task that a controller calls.
    std::shared_ptr<const LearnedMapping> mapping(TomlTable& table, std::string_view key, const std::string& from);
    /// The same, which must read and give what is named here, in this order.
    std::shared_ptr<const LearnedMapping> mapping(TomlTable& table, std::string_view key, const std::string& from,
                                                  std::initializer_list<const char*> inputs,
                                                  std::initializer_list<const char*> outputs);
    /// The keys of the sensor preset that a table names; null after an error, which the table remembers.
    const Value* sensorPreset(TomlTable& table, std::string_view key, const std::string& from);
    /// What the table of a sensor in the file `from` refers to.
    SensorSources sensorSources(const std::string& from, std::shared_ptr<const Shape> shape = nullptr);
    /// A robot's part of a log; nullopt where there is no such log.
    Expected<std::optional<ExcerptContent>> excerpt(const LogExcerpt& excerpt) { return source_.excerpt(excerpt); }

    std::string shown(const std::string& name) const { return source_.shown(name); }
    /// Of a file that holds something else than the file `from` expects under `key`, the error says who names it: a
    /// file beside it may be called as one that ships.
    Error saysWhoNames(Error error, const Value::File& file, const std::string& from, std::string_view key) const;

private:
    /// Null: there is none of that name.
    Expected<Value::File> open(const std::string& name, const std::string& reference, Holds holds);
    std::shared_ptr<const LearnedMapping> mapping(TomlTable& table, const Value::File& file);

    DescriptionSource& source_;
    std::map<std::pair<std::string, Holds>, Value::File> files_;
    std::map<Value::File, std::shared_ptr<const Shape>> shapes_;
    std::map<Value::File, MotionNetwork> networks_;
    std::map<Value::File, std::shared_ptr<const LearnedKicker>> kickers_;
    std::map<Value::File, std::shared_ptr<const LearnedSensor>> sensors_;
    std::map<Value::File, std::shared_ptr<const LearnedMapping>> mappings_;
    /// Checked, with what it refers to, and what of it is for robot files.
    struct Preset {
        Value::File file;
        Value keys;
    };
    std::map<Value::File, Preset> presets_;  ///< by the files as they were
    std::map<std::tuple<const MotionNetwork*, Nanoseconds, Nanoseconds>, std::shared_ptr<const LearnedMotion>> motions_;
};

}  // namespace mrose
