#include "assessment/stream_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace mrose {
namespace {

constexpr std::size_t mostRangeBins = 12, bearingBins = 12;

/// Intervals of a width; the last ends with the span.
std::vector<ShareBin> binsOf(double from, double to, double width) {
    std::vector<ShareBin> bins;
    const auto count = static_cast<std::size_t>(std::ceil((to - from) / width - 1e-9));
    for (std::size_t i = 0; i < count; ++i) {
        const double begin = from + static_cast<double>(i) * width;
        bins.push_back({begin, std::min(to, begin + width), {}});
    }
    return bins;
}

/// The least of 1, 2 and 5 times a power of ten that makes no more than so many of a span.
double roundWidth(double span) {
    double width = 1e-3;
    for (int i = 0; static_cast<double>(mostRangeBins) * width < span; ++i) width *= i % 3 == 1 ? 2.5 : 2;
    return width;
}

/// Which block each look of a stream is in, and how many there are of both streams.
struct Blocks {
    std::map<std::pair<std::size_t, std::int64_t>, std::uint32_t> numbers;
    std::span<const RolloutRequest> requests;

    std::uint32_t of(const SensedLook& look) {
        const RolloutRequest& request = requests[look.request];
        const std::pair key{request.session, (request.start + look.time) / readingBlock};
        return numbers.try_emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second;
    }
};

/// The looks of one of the streams that are asked for, with their blocks.
struct BlockedLooks {
    std::vector<const SensedLook*> looks;
    std::vector<std::uint32_t> blocks;
};

BlockedLooks chosen(const std::vector<SensedLook>& looks, std::optional<std::size_t> robot, Blocks& blocks) {
    BlockedLooks result;
    for (const SensedLook& look : looks) {
        if (robot && look.robot != *robot) continue;
        result.looks.push_back(&look);
        result.blocks.push_back(blocks.of(look));
    }
    return result;
}

/// Sums over blocks of a stream: `add` gives what a look adds.
template <class Add>
std::vector<BlockSum> sums(const BlockedLooks& stream, std::size_t blocks, const Add& add) {
    std::vector<BlockSum> sums(blocks);
    for (std::size_t i = 0; i < stream.looks.size(); ++i) add(*stream.looks[i], sums[stream.blocks[i]]);
    return sums;
}

TwoSampleTest testOf(std::span<const BlockSum> real, std::span<const BlockSum> simulated) {
    std::vector<BlockCounts> counts;
    for (std::size_t i = 0; i < real.size(); ++i)
        counts.push_back({real[i].of, real[i].met, simulated[i].of, simulated[i].met});
    return testShares(counts);
}

void addReports(const SensedLook& look, BlockSum& sum) {
    for (const SensedSubject& subject : look.subjects) {
        sum.of += subject.inView;
        sum.met += subject.inView && subject.reported;
    }
}

void addEmpty(const SensedLook& look, BlockSum& sum) {
    sum.of += 1;
    sum.met += look.empty();
}

/// Shares of one stream by bins of range or bearing.
void fillBins(std::vector<ShareBin>& bins, const BlockedLooks& stream, std::size_t blocks, double SensedSubject::*state,
              BlockShare RealAndSimulated<BlockShare>::*which) {
    if (bins.empty()) return;
    const double from = bins.front().from, width = bins.front().to - from;
    std::vector<std::vector<BlockSum>> sums(bins.size(), std::vector<BlockSum>(blocks));
    for (std::size_t i = 0; i < stream.looks.size(); ++i)
        for (const SensedSubject& subject : stream.looks[i]->subjects) {
            if (!subject.inView) continue;
            const double place = std::floor((subject.*state - from) / width);
            const auto bin = static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(bins.size() - 1)));
            BlockSum& sum = sums[bin][stream.blocks[i]];
            sum.of += 1;
            sum.met += subject.reported;
        }
    for (std::size_t bin = 0; bin < bins.size(); ++bin) bins[bin].reported.*which = shareOf(sums[bin]);
}

ReadingErrors errorsOf(const BlockedLooks& stream, std::size_t blocks, double SensedSubject::*error) {
    std::vector<double> errors;
    const std::vector<BlockSum> sums = mrose::sums(stream, blocks, [&](const SensedLook& look, BlockSum& sum) {
        for (const SensedSubject& subject : look.subjects) {
            if (!subject.reported) continue;
            errors.push_back(subject.*error);
            sum.of += 1;
            sum.met += subject.*error;
        }
    });
    ReadingErrors result;
    result.distribution = distribution(errors);
    double squares = 0;
    for (const double value : errors) {
        const double off = value - result.distribution.mean;
        squares += off * off;
    }
    if (errors.size() > 1) result.deviation = std::sqrt(squares / static_cast<double>(errors.size() - 1));
    result.meanError = shareOf(sums).error;
    return result;
}

void addValues(const BlockedLooks& stream, bool simulated, double SensedSubject::*error,
               std::vector<BlockValue>& values) {
    for (std::size_t i = 0; i < stream.looks.size(); ++i)
        for (const SensedSubject& subject : stream.looks[i]->subjects)
            if (subject.reported) values.push_back({subject.*error, stream.blocks[i], simulated});
}

/// Both streams of one robot, or of all.
struct Streams {
    BlockedLooks real, simulated;
    std::size_t blocks;
};

ComparedErrors comparedErrors(const Streams& streams, double SensedSubject::*error) {
    ComparedErrors compared;
    compared.of = {errorsOf(streams.real, streams.blocks, error), errorsOf(streams.simulated, streams.blocks, error)};
    std::vector<BlockValue> values;
    addValues(streams.real, false, error, values);
    addValues(streams.simulated, true, error, values);
    compared.test = testDistributions(values);
    return compared;
}

/// The empty bins of a sensor's figures.
struct Bins {
    std::vector<ShareBin> byRange, byBearing;

    Bins(const SensorField& field, const LookStreams& looks) {
        double farthest = field.range;
        for (const auto* stream : {&looks.real, &looks.simulated})
            for (const SensedLook& look : *stream)
                for (const SensedSubject& subject : look.subjects)
                    if (field.range == 0 && subject.inView) farthest = std::max(farthest, subject.range);
        if (farthest > 0) byRange = binsOf(0, farthest, roundWidth(farthest));
        const double half = 0.5 * field.fieldOfView, pi = std::numbers::pi;
        double from = field.direction - half, to = field.direction + half;
        if (from < -pi || to > pi) from = -pi, to = pi;
        byBearing = binsOf(from, to, (to - from) / bearingBins);
    }
};

StreamFigures figuresOf(const LookStreams& looks, std::optional<std::size_t> robot,
                        std::span<const RolloutRequest> requests, const Bins& bins) {
    Blocks numbers{{}, requests};
    Streams streams{chosen(looks.real, robot, numbers), chosen(looks.simulated, robot, numbers), 0};
    streams.blocks = numbers.numbers.size();
    StreamFigures figures;
    figures.blocks = streams.blocks;
    figures.looks = {streams.real.looks.size(), streams.simulated.looks.size()};
    const auto share = [&](const auto& add, RealAndSimulated<BlockShare>& shares, TwoSampleTest& test) {
        const auto real = sums(streams.real, streams.blocks, add),
                   simulated = sums(streams.simulated, streams.blocks, add);
        shares = {shareOf(real), shareOf(simulated)};
        test = testOf(real, simulated);
    };
    share(addReports, figures.reported, figures.reportedTest);
    share(addEmpty, figures.empty, figures.emptyTest);
    figures.byRange = bins.byRange;
    figures.byBearing = bins.byBearing;
    using Shares = RealAndSimulated<BlockShare>;
    for (const auto& [stream, which] :
         {std::pair(&streams.real, &Shares::real), std::pair(&streams.simulated, &Shares::simulated)}) {
        fillBins(figures.byRange, *stream, streams.blocks, &SensedSubject::range, which);
        fillBins(figures.byBearing, *stream, streams.blocks, &SensedSubject::bearing, which);
    }
    figures.range = comparedErrors(streams, &SensedSubject::rangeError);
    figures.bearing = comparedErrors(streams, &SensedSubject::bearingError);
    return figures;
}

}  // namespace

ComparedSensor compareStreams(const SensorPair& pair, LookStreams looks, std::span<const RolloutRequest> requests) {
    ComparedSensor compared{pair.name, pair.field, std::move(looks), {}, {}};
    const Bins bins(pair.field, compared.looks);
    for (std::size_t robot = 0; robot < pair.sensors.size(); ++robot)
        compared.robots.push_back(pair.sensors[robot] ? std::optional(figuresOf(compared.looks, robot, requests, bins))
                                                      : std::nullopt);
    compared.all = figuresOf(compared.looks, std::nullopt, requests, bins);
    return compared;
}

}  // namespace mrose
