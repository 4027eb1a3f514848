#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/reading.h"
#include "geometry/point.h"
#include "world/command.h"

namespace mrose {

// The readings of the sensors that every robot has.
constexpr ReadingName selfReading = "self";          ///< one Pose in the world's frame, as measured last
constexpr ReadingName odometryReading = "odometry";  ///< one Velocity, own, now
constexpr ReadingName robotsReading = "robots";      ///< SeenBody, those in sight, in the order of their indices
constexpr ReadingName objectsReading = "objects";    ///< likewise; the ball is index 0, where there is one
constexpr ReadingName messagesReading = "messages";  ///< ReceivedMessage, those that arrived since the last instant

/// Which readings a controller reads of its observations. The others are left out, and what they cost is saved.
struct Attention {
    bool all = true;
    std::vector<ReadingName> names = {};  ///< those it reads, where not all

    static Attention only(std::vector<ReadingName> names) { return {false, std::move(names)}; }
    /// Its own pose and speed alone.
    static Attention ofItself() { return only({selfReading, odometryReading}); }
    bool reads(const ReadingName& name) const {
        return all || std::find(names.begin(), names.end(), name) != names.end();
    }
    bool operator==(const Attention&) const = default;
};

/// What a controller gets to see: the readings that have arrived. It never sees the world's state.
class Observation {
public:
    std::uint32_t robot = 0;         ///< whose it is
    std::uint32_t manipulators = 0;  ///< how many it has
    Nanoseconds time = 0;            ///< now
    std::uint64_t noise = 0;         ///< 64 random bits of this instant, for controllers that draw random numbers

    /// Asked for a reading that is left out, it throws std::logic_error from now on. nullptr: none is.
    void leaveOut(const Attention* otherThan) { attention_ = otherThan; }

    /// In the order of the robot's sensors.
    std::span<const Reading> readings() const { return std::span(readings_).first(used_); }
    /// The first of that name, the oldest where a sensor with a clock of its own gave several; nullptr: there is none.
    const Reading* find(const ReadingName& name) const {
        for (const Reading& reading : readings())
            if (reading.name == name) return &reading;
        checkAsked(name);
        return nullptr;
    }
    /// The last of that name, the newest.
    const Reading* newest(const ReadingName& name) const {
        const Reading* found = nullptr;
        for (const Reading& reading : readings())
            if (reading.name == name) found = &reading;
        if (found == nullptr) checkAsked(name);
        return found;
    }
    /// The records of a reading; empty where there is none, or they are of another type.
    template <class T>
    std::span<const T> records(const Reading* reading) const {
        if (reading == nullptr || !isOf(*reading, recordType<T>())) return {};
        return {reinterpret_cast<const T*>(recordsOf(*reading)), reading->count};
    }
    /// The same of the first reading of that name.
    template <class T>
    std::span<const T> records(const ReadingName& name) const {
        return records<T>(find(name));
    }
    const std::byte* recordsOf(const Reading& reading) const { return data_.data() + reading.first; }

    // The same of the sensors that every robot has.
    bool localised() const { return asked(self_, selfReading).count > 0; }  ///< false until the first measurement
    /// Its own pose in the world's frame, as measured last.
    Pose self() const { return firstOf<Pose>(asked(self_, selfReading)); }
    Nanoseconds selfMeasured() const { return asked(self_, selfReading).measured; }
    Velocity velocity() const { return firstOf<Velocity>(asked(odometry_, odometryReading)); }  ///< own, now
    std::span<const SeenBody> robots() const { return allOf<SeenBody>(asked(robots_, robotsReading)); }
    std::span<const SeenBody> objects() const { return allOf<SeenBody>(asked(objects_, objectsReading)); }
    std::span<const ReceivedMessage> messages() const { return records<ReceivedMessage>(messagesReading); }

    void clearReadings() {
        used_ = 0, dataSize_ = 0;
        self_ = odometry_ = robots_ = objects_ = {};
    }
    /// Adds a reading at the end; gives the place for its records, valid until the next is added.
    std::byte* add(const ReadingName& name, const RecordType& type, Nanoseconds measured, std::size_t count);
    template <class T>
    void add(const ReadingName& name, Nanoseconds measured, std::span<const T> records) {
        static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 8);
        const Place place = append(name, recordType<T>(), measured, records.size());
        note<T>(name, place);
        if (!records.empty()) std::memcpy(data_.data() + place.first, records.data(), records.size_bytes());
    }
    template <class T>
    void add(const ReadingName& name, Nanoseconds measured, const T& record) {
        add(name, measured, std::span<const T>(&record, 1));
    }

    /// Number by number: what pads records does not count.
    bool operator==(const Observation& other) const;

private:
    static bool isOf(const Reading& reading, const RecordType& type) {
        return reading.type == &type || (reading.type != nullptr && *reading.type == type);
    }
    /// Where the records of a sensor lie that every robot has, of the first reading.
    struct Place {
        std::uint32_t first = 0, count = 0;
        Nanoseconds measured = 0;
    };
    template <class T>
    std::span<const T> allOf(const Place& place) const {
        return {reinterpret_cast<const T*>(data_.data() + place.first), place.count};
    }
    template <class T>
    T firstOf(const Place& place) const {
        return place.count > 0 ? allOf<T>(place).front() : T{};
    }
    void checkAsked(const ReadingName& name) const {
        if (attention_ != nullptr && !attention_->reads(name)) refuse(name);
    }
    const Place& asked(const Place& place, const ReadingName& name) const {
        if (place.count == 0) checkAsked(name);
        return place;
    }
    [[noreturn]] static void refuse(std::string_view name) {
        throw std::logic_error("it reads '" + std::string(name) + "', which its attention() leaves out");
    }
    Place append(const ReadingName& name, const RecordType& type, Nanoseconds measured, std::size_t count);
    /// Where a reading of Ts lies, if it is one that every robot has.
    template <class T>
    void note(const ReadingName& name, const Place& place) {
        const auto noteAs = [&](Place& standard, const ReadingName& its) {
            if (name == its && standard.count == 0) standard = place;
        };
        if constexpr (std::is_same_v<T, Pose>) noteAs(self_, selfReading);
        if constexpr (std::is_same_v<T, Velocity>) noteAs(odometry_, odometryReading);
        if constexpr (std::is_same_v<T, SeenBody>) noteAs(robots_, robotsReading), noteAs(objects_, objectsReading);
    }
    void makeRoom();

    Place self_, odometry_, robots_, objects_;
    const Attention* attention_ = nullptr;
    std::vector<Reading> readings_;  ///< the first `used_` of them
    std::size_t used_ = 0;
    std::vector<std::byte> data_;  ///< records of all, each reading's at a multiple of 8; the first `dataSize_` bytes
    std::size_t dataSize_ = 0;
};

}  // namespace mrose
