#include "report/stream_json.h"

#include "report/results_json.h"

namespace mrose {
namespace {

using Json = nlohmann::ordered_json;

Json json(const BlockShare& share) { return {{"of", share.of}, {"share", share.share}, {"error", share.error}}; }

Json json(const TwoSampleTest& test) { return {{"statistic", test.statistic}, {"p", test.p}, {"blocks", test.blocks}}; }

Json json(const RealAndSimulated<BlockShare>& both) {
    return {{"real", json(both.real)}, {"simulated", json(both.simulated)}};
}

Json json(const RealAndSimulated<BlockShare>& both, const TwoSampleTest& test) {
    Json result = json(both);
    result["test"] = json(test);
    return result;
}

Json json(const std::vector<ShareBin>& bins, const char* from, const char* to) {
    Json result = Json::array();
    for (const ShareBin& bin : bins) {
        Json one{{from, bin.from}, {to, bin.to}};
        one.update(json(bin.reported));
        result.push_back(std::move(one));
    }
    return result;
}

Json json(const ReadingErrors& errors) {
    Json result = mrose::json(errors.distribution);
    result["sd"] = errors.deviation;
    result["mean_error"] = errors.meanError;
    return result;
}

Json json(const ComparedErrors& errors) {
    return {{"real", json(errors.of.real)}, {"simulated", json(errors.of.simulated)}, {"test", json(errors.test)}};
}

Json json(const StreamFigures& figures) {
    return {{"blocks", figures.blocks},
            {"looks", {{"real", figures.looks.real}, {"simulated", figures.looks.simulated}}},
            {"reported", json(figures.reported, figures.reportedTest)},
            {"empty", json(figures.empty, figures.emptyTest)},
            {"reported_by_range", json(figures.byRange, "from_m", "to_m")},
            {"reported_by_bearing", json(figures.byBearing, "from_rad", "to_rad")},
            {"range_error_m", json(figures.range)},
            {"bearing_error_rad", json(figures.bearing)}};
}

}  // namespace

Json streamsJson(const Comparison& comparison) {
    Json result = Json::array();
    for (const ComparedSensor& sensor : comparison.sensors) {
        Json robots = Json::array();
        for (std::size_t i = 0; i < sensor.robots.size(); ++i) {
            if (!sensor.robots[i]) continue;
            Json robot{{"name", comparison.robots[i].name}, {"robot", comparison.robots[i].realName}};
            robot.update(json(*sensor.robots[i]));
            robots.push_back(std::move(robot));
        }
        result.push_back({{"sensor", sensor.name},
                          {"block_s", toSeconds(readingBlock)},
                          {"arrangements", blockSwaps + 1},
                          {"all", json(sensor.all)},
                          {"robots", std::move(robots)}});
    }
    return result;
}

}  // namespace mrose
