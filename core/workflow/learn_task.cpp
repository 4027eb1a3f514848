#include "workflow/learn_task.h"

#include "io/file.h"
#include "report/task_report.h"
#include "workflow/outputs.h"

namespace mrose {

Expected<LearnedTask> learnTask(const LearnRequest& request, const Progress& progress) {
    const auto table = readResultsTable(request.results);
    if (!table) return tl::unexpected(table.error());
    if (const auto can = checkOutput(request.output, {table->file}, request.overwrite); !can)
        return tl::unexpected(can.error());
    if (!request.report.empty())
        if (const auto can = checkTaskReportFolder(request.report, request.overwrite); !can)
            return tl::unexpected(can.error());
    auto data = taskData(*table, request.question);
    if (!data) return tl::unexpected(data.error());
    std::vector<TaskLearning> all{request.learning};
    for (std::size_t i = 0; request.families && i < regressorFamilyNames.size(); ++i) {
        if (static_cast<RegressorFamily>(i) == request.learning.family) continue;
        all.push_back(request.learning);
        all.back().family = static_cast<RegressorFamily>(i);
    }
    std::vector<TaskNetwork> networks;
    for (const TaskLearning& learning : all) {
        auto network = learnTask(*data, learning, [&](double share) {
            return mayGoOn(progress, (static_cast<double>(networks.size()) + share) / static_cast<double>(all.size()));
        });
        if (!network) return atFile(network.error(), table->file);
        networks.push_back(std::move(*network));
    }
    NetworkTraining& training = networks.front().learned.training;
    training.command = request.command;
    const auto bytes = readFile(table->file);
    if (!bytes) return tl::unexpected(bytes.error());
    training.logs = {{table->file, contentHash(*bytes)}};
    TaskJudgement judgement = judge(*data, networks, request.question.greatest);
    if (const auto written = writeFileAtomically(request.output, taskFileText(networks.front())); !written)
        return tl::unexpected(written.error());
    LearnedTask learned{std::move(networks.front()), std::move(*data), std::move(judgement)};
    if (request.report.empty()) return learned;
    ReportContext context;
    context.program = "mrose " MROSE_VERSION;
    context.commandLine = request.command;
    const auto written = writeTaskReport(
        {table->file, request.output, learned.network, learned.data, learned.judgement}, context, request.report);
    if (!written) return tl::unexpected(written.error());
    return learned;
}

}  // namespace mrose
