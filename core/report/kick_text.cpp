#include "report/kick_text.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "report/results_json.h"

namespace mrose {
namespace {

nlohmann::json printedQuantity(const KickScores::Quantity& of, const char* unit) {
    return {{std::string("crps_") + unit, of.crps}, {"inside_50", of.inside50}, {"inside_90", of.inside90}};
}

}  // namespace

std::string kickTrainingJson(const KickNetwork& network, const std::vector<std::string>& notices,
                             const std::string& file, double seconds) {
    const KickNetwork::Constant& c = network.constant;
    return nlohmann::json{{"network", file},
                          {"synthetic", network.learned.synthetic},
                          {"seconds", seconds},
                          {"kicks", network.heldOut.kicks},
                          {"hits", network.heldOut.hits},
                          {"held_out_hit_log_likelihood", network.heldOut.hit},
                          {"held_out_delay_log_likelihood", network.heldOut.delay},
                          {"held_out_departure_log_likelihood", network.heldOut.departure},
                          {"constant", {{"dead_time_s", c.deadTime}, {"speed_mps", c.speedAtFull}, {"hits", c.hits}}},
                          {"notices", notices}}
        .dump(2);
}

std::string kickScoresJson(std::span<const KickScores> scores, bool synthetic,
                           const std::vector<std::string>& notices) {
    nlohmann::json json{{"synthetic", synthetic}, {"notices", notices}, {"models", nlohmann::json::array()}};
    for (const KickScores& of : scores)
        json["models"].push_back({{"name", of.name},
                                  {"kicks", of.kicks},
                                  {"hits", of.hits},
                                  {"hit_log_likelihood", of.hit},
                                  {"delay_log_likelihood", finiteOrNull(of.delay)},
                                  {"departure_log_likelihood", finiteOrNull(of.departure)},
                                  {"delay", printedQuantity(of.quantities[0], "s")},
                                  {"speed", printedQuantity(of.quantities[1], "mps")},
                                  {"direction", printedQuantity(of.quantities[2], "rad")}});
    return json.dump(2);
}

}  // namespace mrose
