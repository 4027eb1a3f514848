#include "logs/csv_channels.h"

#include <algorithm>

#include "geometry/pose.h"
#include "io/format.h"
#include "logs/conditioning.h"

namespace mrose {
namespace {

constexpr std::size_t vChannel = 0, wChannel = 1, xChannel = 2, yChannel = 3, headingChannel = 4;

using Values = std::vector<StampedValue>;

/// Calls the function with each stream in turn until one fails.
template <class Function>
Expected<void> forEachStream(CsvChannels& channels, Function function) {
    Expected<void> result = function(channels.commands);
    if (result) result = function(channels.poses);
    for (auto& stream : channels.alone)
        if (result) result = function(stream);
    if (result) result = function(channels.kicks);
    if (result) result = function(channels.ball);
    return result;
}

/// Whole samples taken apart, into the channels where values stand alone.
void takeApart(CsvChannels& channels) {
    const auto put = [&](std::size_t channel, Nanoseconds time, double value) {
        channels.alone[channel].samples.push_back({time, value});
    };
    if (!channels.alone[vChannel].samples.empty() || !channels.alone[wChannel].samples.empty()) {
        for (const auto& [time, command] : channels.commands.samples) {
            put(vChannel, time, command.v);
            put(wChannel, time, command.w);
        }
        channels.commands.samples.clear();
    }
    const auto isUsed = [](const auto& stream) { return !stream.samples.empty(); };
    if (std::none_of(channels.alone.begin() + xChannel, channels.alone.end(), isUsed)) return;
    for (const auto& [time, pose] : channels.poses.samples) {
        put(xChannel, time, pose.x);
        put(yChannel, time, pose.y);
        put(headingChannel, time, pose.heading);
    }
    channels.poses.samples.clear();
}

/// Both hold until their next value; what comes before the other's first is dropped.
std::vector<StampedCommand> pairCommands(const Values& v, const Values& w, LogDefects& defects) {
    std::vector<StampedCommand> commands;
    for (std::size_t i = 0, j = 0; i < v.size() || j < w.size();) {
        const bool takeV = j == w.size() || (i < v.size() && v[i].time <= w[j].time);
        const bool takeW = i == v.size() || (j < w.size() && w[j].time <= v[i].time);
        const Nanoseconds time = takeV ? v[i].time : w[j].time;
        i += takeV;
        j += takeW;
        if (i > 0 && j > 0)
            commands.push_back({time, {v[i - 1].value, w[j - 1].value}});
        else
            ++defects.unpaired;
    }
    return commands;
}

/// A channel read at rising instants.
class Interpolator {
public:
    Interpolator(const Values& values, Nanoseconds longest, bool angle)
        : values_(values), longest_(longest), angle_(angle) {}

    /// False where the channel does not reach to both sides of `time` closely enough.
    bool at(Nanoseconds time, double& value) {
        while (next_ < values_.size() && values_[next_].time < time) ++next_;
        if (next_ == values_.size()) return false;
        const StampedValue& after = values_[next_];
        value = after.value;
        if (after.time == time) return true;
        if (next_ == 0 || after.time - values_[next_ - 1].time > longest_) return false;
        const StampedValue& before = values_[next_ - 1];
        const double share = static_cast<double>(time - before.time) / static_cast<double>(after.time - before.time);
        const double change = after.value - before.value;
        value = before.value + share * (angle_ ? wrapAngle(change) : change);
        return true;
    }

private:
    const Values& values_;
    Nanoseconds longest_;
    bool angle_;
    std::size_t next_ = 0;
};

std::vector<StampedPose> pairPoses(const Values& x, const Values& y, const Values& heading, Nanoseconds longest,
                                   LogDefects& defects) {
    std::vector<StampedPose> poses;
    Interpolator yAt(y, longest, false), headingAt(heading, longest, true);
    for (const auto& [time, value] : x) {
        StampedPose sample{time, {value, 0, 0}};
        const bool hasY = yAt.at(time, sample.pose.y), hasHeading = headingAt.at(time, sample.pose.heading);
        if (hasY && hasHeading)
            poses.push_back(sample);
        else
            ++defects.unpaired;
    }
    if (x.empty()) defects.unpaired += static_cast<std::int64_t>(std::max(y.size(), heading.size()));
    return poses;
}

/// The row's kick and ball. Whether it has one of them.
Expected<bool> addBall(CsvChannels& channels, const CsvRows& rows, const CsvCells& cells) {
    const Nanoseconds time = cells[CsvColumn::time]->instant;
    const CsvCell *kick = cells[CsvColumn::kick], *x = cells[CsvColumn::ballX], *y = cells[CsvColumn::ballY];
    if ((x == nullptr) != (y == nullptr)) return failEmpty(rows, x == nullptr ? CsvColumn::ballX : CsvColumn::ballY);
    if (kick != nullptr && !(kick->number >= 0 && kick->number <= 1))
        return failCell(rows, CsvColumn::kick,
                        "expected the power of a kick, 0 to 1, found " + numberText(kick->number));
    if (kick != nullptr) channels.kicks.add({time, kick->number}, rows.position());
    if (x != nullptr) channels.ball.add({time, {x->number, y->number}}, rows.position());
    return kick != nullptr || x != nullptr;
}

}  // namespace

Expected<bool> CsvChannels::add(const CsvRows& rows, const CsvCells& cells) {
    const char* const place = rows.position();
    const Nanoseconds time = cells[CsvColumn::time]->instant;
    std::array<const CsvCell*, csvChannels> row{};
    for (std::size_t channel = 0; channel < csvChannels; ++channel) row[channel] = cells[CsvColumn(channel)];
    const auto addAlone = [&](std::size_t channel) {
        if (row[channel] != nullptr) alone[channel].add({time, row[channel]->number}, place);
    };
    if (row[vChannel] != nullptr && row[wChannel] != nullptr) {
        commands.add({time, {row[vChannel]->number, row[wChannel]->number}}, place);
    } else {
        addAlone(vChannel);
        addAlone(wChannel);
    }
    if (row[xChannel] != nullptr && row[yChannel] != nullptr && row[headingChannel] != nullptr) {
        poses.add({time, {row[xChannel]->number, row[yChannel]->number, row[headingChannel]->number}}, place);
    } else {
        for (const std::size_t channel : {xChannel, yChannel, headingChannel}) addAlone(channel);
    }
    const bool driven = std::any_of(row.begin(), row.end(), [](const CsvCell* cell) { return cell != nullptr; });
    return addBall(*this, rows, cells).map([&](bool ball) { return ball || driven; });
}

Expected<void> endFile(CsvChannels& channels, std::string_view content, const std::string& name, LogDefects& defects) {
    return forEachStream(channels, [&](auto& stream) { return endFile(stream, content, name, defects.outOfOrder); });
}

void merge(CsvChannels& channels, const LogOptions& options, Trajectory& trajectory, LogDefects& defects) {
    takeApart(channels);
    for (auto& stream : channels.alone) {
        std::stable_sort(stream.samples.begin(), stream.samples.end(), earlier<StampedValue>);
        keepLastOfEqualStamps(stream.samples, defects);
    }
    auto& alone = channels.alone;
    trajectory.commands = std::move(channels.commands.samples);
    if (trajectory.commands.empty())
        trajectory.commands = pairCommands(alone[vChannel].samples, alone[wChannel].samples, defects);
    trajectory.poses = std::move(channels.poses.samples);
    if (trajectory.poses.empty())
        trajectory.poses = pairPoses(alone[xChannel].samples, alone[yChannel].samples, alone[headingChannel].samples,
                                     fromSeconds(options.poseGap), defects);
    conditionCommands(trajectory.commands, options, defects, &trajectory.blips);
    conditionPoses(trajectory.poses, options, defects);
    trajectory.kicks = std::move(channels.kicks.samples);
    trajectory.ball = std::move(channels.ball.samples);
    conditionKicks(trajectory.kicks, defects);
    conditionBall(trajectory.ball, options, defects);
}

}  // namespace mrose
