#include "tasks/task_judgement.h"

#include <cmath>
#include <map>

#include "tasks/task_learning.h"

namespace mrose {

TaskScore scoreOf(const TaskData& judged, const std::vector<double>& predicted) {
    struct Sums {
        double error = 0, value = 0;
    };
    std::map<std::uint32_t, Sums> trials;
    TaskScore score;
    Sums all;
    for (std::size_t i = 0; i < judged.y.size(); ++i) {
        const double off = predicted[i] - judged.y[i];
        if (std::isnan(off)) continue;
        ++score.values;
        score.bias += off;
        score.rootMeanSquare += off * off;
        all.error += std::abs(off), all.value += std::abs(judged.y[i]);
        Sums& of = trials[judged.trial[i / judged.outputs()]];
        of.error += std::abs(off), of.value += std::abs(judged.y[i]);
    }
    if (score.values == 0) return score;
    const auto count = static_cast<double>(score.values);
    score.bias /= count;
    score.rootMeanSquare = std::sqrt(score.rootMeanSquare / count);
    score.absolute = all.error / count;
    score.share = all.error / all.value;
    std::vector<Sums> each;
    for (const auto& [trial, sums] : trials) each.push_back(sums);
    score.shareInterval = bootstrapInterval(each.size(), [&](std::span<const std::size_t> drawn) {
        Sums sums;
        for (const std::size_t i : drawn) sums.error += each[i].error, sums.value += each[i].value;
        return sums.error / sums.value;
    });
    return score;
}

TaskJudgement judge(const TaskData& data, const std::vector<TaskNetwork>& learned, bool greatest) {
    TaskJudgement judgement;
    judgement.heldOut = data.part(TaskLearning::every, TaskLearning::offset, true);
    const TaskData others = data.part(TaskLearning::every, TaskLearning::offset, false);
    judgement.learnedFrom = others.rows();
    const TaskData& held = judgement.heldOut;
    const auto add = [&](std::string_view name, std::vector<double> predicted) {
        const TaskScore score = scoreOf(held, predicted);
        judgement.predictors.push_back({std::string(name), std::move(predicted), score, {}});
    };
    for (const TaskNetwork& network : learned) {
        add(nameOf(familyOf(network.learned.regressor)), predictions(network, held));
        TaskJudgement::Predictor& predictor = judgement.predictors.back();
        if (!data.variants.empty()) predictor.choice = judgeChoice(others, held, predictor.predicted, greatest);
    }
    for (const TaskData::Guess& guess : held.beside) add(guess.name, guess.of);
    std::vector<double> means(data.outputs()), everywhere;
    for (std::size_t i = 0; i < others.y.size(); ++i)
        means[i % means.size()] += others.y[i] / static_cast<double>(others.rows());
    for (std::size_t row = 0; row < held.rows(); ++row) everywhere.insert(everywhere.end(), means.begin(), means.end());
    add("mean of all", std::move(everywhere));
    return judgement;
}

}  // namespace mrose
