#include "sensing/radio_traffic.h"

#include <algorithm>

#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

// Up to here all are looked at, whatever the range.
constexpr std::size_t messagesOfOneCell = 32;

/// Loss and jitter of a message at a receiver. Senders are told apart up to 262144.
NoisePair radioDraws(const WorldState& state, const SentMessage& message, std::uint32_t robot) {
    const auto part = static_cast<std::uint32_t>(message.number << 18 | (message.from & 0x3ffff));
    return uniformPair({state.seed, message.tick, robot, channelOf(NoiseChannel::radio, part)});
}

/// Numbers sorted by keys below `keys`, equal ones in their order; where each key's begin.
template <class KeyOf>
void sortByKey(std::size_t count, std::size_t keys, KeyOf keyOf, std::vector<std::uint32_t>& begins,
               std::vector<std::uint32_t>& sorted) {
    begins.assign(keys + 2, 0);
    for (std::uint32_t i = 0; i < count; ++i)
        if (const std::size_t key = keyOf(i); key < keys) ++begins[key + 2];
    for (std::size_t key = 2; key < begins.size(); ++key) begins[key] += begins[key - 1];
    sorted.resize(begins.back());
    for (std::uint32_t i = 0; i < count; ++i)
        if (const std::size_t key = keyOf(i); key < keys) sorted[begins[key + 1]++] = i;
    begins.pop_back();
}

}  // namespace

void RadioTraffic::arrange(const Scene& scene, std::span<const std::uint32_t> teams, const WorldState& state) {
    known_ = true;
    const std::vector<SentMessage>& messages = state.messages;
    constexpr std::size_t nowhere = noTeam;
    const auto mayBeDue = [&](const SentMessage& m) {
        return teams[m.from] != noTeam && m.tick + arrivalTicks(m.latency, scene.tickLength) <= state.tick;
    };
    std::size_t teamCount = 0;
    for (const std::uint32_t team : teams)
        if (team != noTeam) teamCount = std::max<std::size_t>(teamCount, team + 1);
    sortByKey(
        messages.size(), teamCount,
        [&](std::uint32_t i) {
            const SentMessage& m = messages[i];
            return m.to == noBody && mayBeDue(m) ? teams[m.from] : nowhere;
        },
        teamBegins_, toTeam_);
    sortByKey(
        messages.size(), teams.size(),
        [&](std::uint32_t i) {
            const SentMessage& m = messages[i];
            return m.to != noBody && teams[m.to] == teams[m.from] && mayBeDue(m) ? m.to : nowhere;
        },
        toBegins_, toRobot_);
    byPlace_ = scene.radio.range > 0 && toTeam_.size() > messagesOfOneCell;
    if (byPlace_) arrangeByPlace(scene, state);
}

void RadioTraffic::arrangeByPlace(const Scene& scene, const WorldState& state) {
    places_.clear();
    for (const std::uint32_t message : toTeam_) places_.push_back(state.messages[message].position);
    grid_.fill(places_, scene.radio.range / 2, 1);
}

void RadioTraffic::add(const Scene& scene, const WorldState& state, std::uint32_t message, std::uint32_t robot) {
    const SentMessage& m = state.messages[message];
    const std::int64_t last = state.robots[robot].lastControl, ticks = arrivalTicks(m.latency, scene.tickLength);
    if (m.from == robot ||
        m.tick + (m.jitter == 0 ? ticks : arrivalTicks(m.latency + m.jitter, scene.tickLength)) <= last)
        return;
    Transmission sent{message, robot, scene.timeOf(m.tick) + m.latency, position(state.robots[robot].pose)};
    const bool random = m.jitter > 0 || scene.radio.loss > 0;
    const NoisePair draws = random ? radioDraws(state, m, robot) : NoisePair{1, 0};
    if (m.jitter > 0) {
        const auto later = static_cast<Nanoseconds>(draws.second * static_cast<double>(m.jitter));
        const std::int64_t tick = m.tick + arrivalTicks(m.latency + later, scene.tickLength);
        if (tick > state.tick || tick <= last) return;
        sent.arrival += later;
    }
    if (const double range = scene.radio.range; range > 0 && distance(m.position, sent.position) > range)
        sent.outcome = Transmission::Outcome::outOfRange;
    else if (draws.first < scene.radio.loss)
        sent.outcome = Transmission::Outcome::lost;
    due_.push_back(sent);
}

std::span<const Transmission> RadioTraffic::due(const Scene& scene, std::span<const std::uint32_t> teams,
                                                const WorldState& state, std::uint32_t robot, double noted) {
    due_.clear();
    const std::uint32_t team = teams[robot];
    if (team == noTeam || state.messages.empty()) return due_;
    if (!known_) arrange(scene, teams, state);
    const Point here = position(state.robots[robot].pose);
    const double reach = scene.radio.range * noted;
    if (byPlace_) {
        grid_.visitBox(here - Point{reach, reach}, here + Point{reach, reach}, [&](auto entries) {
            for (const PointGrid::Entry& entry : entries)
                if (entry.number >= teamBegins_[team] && entry.number < teamBegins_[team + 1] &&
                    distance(entry.point, here) <= reach)
                    add(scene, state, toTeam_[entry.number], robot);
        });
    } else {
        for (std::uint32_t i = teamBegins_[team]; i < teamBegins_[team + 1]; ++i) {
            const std::uint32_t message = toTeam_[i];
            if (reach == 0 || distance(state.messages[message].position, here) <= reach)
                add(scene, state, message, robot);
        }
    }
    for (std::uint32_t i = toBegins_[robot]; i < toBegins_[robot + 1]; ++i) add(scene, state, toRobot_[i], robot);
    const auto before = [](const Transmission& a, const Transmission& b) {
        return a.arrival != b.arrival ? a.arrival < b.arrival : a.message < b.message;
    };
    if (!std::is_sorted(due_.begin(), due_.end(), before)) std::sort(due_.begin(), due_.end(), before);
    return due_;
}

}  // namespace mrose
