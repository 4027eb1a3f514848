#include "export/report_export.h"

#include <QDir>

#include "export/export_outcome.h"
#include "frame/actions.h"
#include "io/file.h"
#include "io/format.h"
#include "io/shell_quoted.h"
#include "report/comparison_report.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr double pluginLimit = 2;  // s
/// Of its progress the rest is writing.
constexpr double computing = 0.95;
/// Of a comparison's; the rest are causes.
constexpr double comparing = 0.5;

using Outcome = BackgroundWork::Outcome;

Expected<void> freeFolder(Expected<void> check) {
    if (!check && check.error().cause == notOverwritten) {
        Error error = check.error();
        error.cause = "is there already; expected another folder, or leave to replace it";
        return tl::unexpected(std::move(error));
    }
    return check;
}

std::string listOf(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
}

/// The command that writes the same.
std::string commandOf(const EvaluateRequest& request, const std::string& folder) {
    std::string text = "mrose evaluate " + shellQuoted(request.network) + " --log " + shellQuoted(request.log);
    if (!request.robots.empty()) text += " --robots " + shellQuoted(listOf(request.robots));
    for (const std::string& other : request.against) text += " --against " + shellQuoted(other);
    return text + " --report " + shellQuoted(folder);
}

std::string commandOf(const CompareRequest& request, const std::string& folder) {
    const DivergenceRequest& divergence = request.divergence;
    std::string text = "mrose compare";
    const auto add = [&text](const char* flag, const std::string& value) {
        if (!value.empty()) text += flag + (' ' + shellQuoted(value));
    };
    const auto addNumber = [&](const char* flag, const std::optional<double>& value) {
        if (value) add(flag, numberText(*value));
    };
    add("", request.scenario);
    add(" --log", request.log);
    add(" --robot", request.robotFile);
    add(" --robots", listOf(request.robots));
    if (request.start > 0) addNumber(" --start", request.start);
    addNumber(" --duration", request.duration);
    addNumber(" --every", request.every);
    add(" --windows", request.windows);
    if (request.seed) add(" --seed", std::to_string(*request.seed));
    addNumber(" --bound-position", divergence.position);
    addNumber(" --bound-heading", divergence.heading);
    for (const std::string& model : divergence.models) add(" --model", model);
    add(" --report", folder);
    return text;
}

/// `make` gives what `write` writes; both may take long.
template <class Made>
Outcome makeAndWrite(const std::function<Expected<Made>(const Progress&)>& make,
                     const std::function<Expected<void>(const Made&)>& write, const Progress& progress) {
    const auto made = make([&](double share) { return progress(computing * share); });
    if (!progress(computing)) return false;
    if (!made) return tl::unexpected(made.error());
    if (auto written = write(*made); !written) return tl::unexpected(written.error());
    return true;
}

QString pageIn(const QString& folder) { return QDir(folder).filePath("report.html"); }

}  // namespace

Expected<void> exportReport(const Exports& exports, EvaluateRequest request, const QString& folder, bool overwrite) {
    const std::string path = folder.toStdString();
    if (auto can = freeFolder(checkReportFolder(path, overwrite)); !can) return can;
    request.command = commandOf(request, path);
    request.withAdvice = true;
    return exportInBackground(
        exports, {QObject::tr("Evaluating %1").arg(qtText(request.network)), pageIn(folder)},
        [request, path](const Progress& progress) {
            return makeAndWrite<NetworkEvaluation>(
                [&](const Progress& part) { return evaluateNetwork(request, part); },
                [&](const NetworkEvaluation& made) { return writeReport(made.evaluation, made.context, path); },
                progress);
        });
}

Expected<void> exportComparison(const Exports& exports, CompareRequest request, const QString& folder, bool overwrite) {
    const std::string path = folder.toStdString();
    if (auto can = freeFolder(checkComparisonFolder(path, overwrite)); !can) return can;
    request.command = commandOf(request, path);
    request.plugins.limit = pluginLimit;
    return exportInBackground(
        exports, {QObject::tr("Comparing %1").arg(qtText(request.log)), pageIn(folder)},
        [request, path](const Progress& progress) {
            return makeAndWrite<LogComparison>(
                [&](const Progress& part) {
                    return compareLog(request,
                                      {[&](double share) { return part(comparing * share); },
                                       [&](double share) { return part(comparing + (1 - comparing) * share); }});
                },
                [&](const LogComparison& made) {
                    return writeComparison(made.comparison, made.world.parts().scene, made.context, path,
                                           &made.divergences);
                },
                progress);
        });
}

}  // namespace mrose::gui
