#pragma once

#include <filesystem>
#include <string>

#include "learning/task_network.h"
#include "report/page.h"
#include "tasks/task_judgement.h"

namespace mrose {

/// What a page about a learned task says.
struct TaskReport {
    std::string results;  ///< the file that it was learned from
    std::string file;     ///< the network file
    const TaskNetwork& network;
    const TaskData& data;
    const TaskJudgement& judgement;
};

Expected<void> checkTaskReportFolder(const std::filesystem::path& folder, bool overwrite = true);

/// Writes report.html (one file that needs nothing else) and predictions.csv (what is held out, and what all said of
/// it) into `folder`, which is made where it is missing.
Expected<void> writeTaskReport(const TaskReport& report, const ReportContext& context,
                               const std::filesystem::path& folder);

std::string taskReportHtml(const TaskReport& report, const ReportContext& context);
std::string taskPredictionsCsv(const TaskJudgement& judgement);

}  // namespace mrose
