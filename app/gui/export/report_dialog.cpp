#include "export/report_dialog.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <filesystem>
#include <map>

#include "export/report_export.h"
#include "frame/actions.h"
#include "frame/window_memory.h"
#include "io/format.h"
#include "reality/overlay.h"
#include "widgets/qt_text.h"
#include "widgets/warning_style.h"
#include "workflow/resources.h"

namespace mrose::gui {
namespace {

constexpr int lineWidth = 380, numberWidth = 76;

std::string textOf(const QLineEdit* line) { return line->text().trimmed().toStdString(); }

std::vector<std::string> listFrom(const QLineEdit* line) {
    std::vector<std::string> list;
    for (const QString& word : line->text().split(',', Qt::SkipEmptyParts))
        if (!word.trimmed().isEmpty()) list.push_back(word.trimmed().toStdString());
    return list;
}

Expected<void> needed(std::initializer_list<std::pair<const QLineEdit*, const char*>> lines) {
    for (const auto& [line, what] : lines)
        if (line->text().trimmed().isEmpty()) return fail("", std::string("choose ") + what + " first");
    return {};
}

/// Where the network of an overlay's model lies; empty: it is none.
QString networkFile(const JudgedModel& model) {
    if (!model.name.ends_with(".net")) return {};
    const std::filesystem::path shipped = resourceFolder() / "nets" / model.name;
    std::error_code ignored;
    for (const std::filesystem::path& place : {std::filesystem::path(model.named), shipped})
        if (!place.empty() && std::filesystem::exists(place, ignored)) return qtText(place.string());
    return {};
}

QString shortest(double number) { return QString::number(number, 'g', QLocale::FloatingPointShortest); }

/// Where the simulated robots start, and when they have left the real trajectory.
void addPlan(std::map<QString, QString>& lines, const Overlay& overlay) {
    using Cut = RolloutPlan::Cut;
    const RolloutPlan& plan = overlay.rollouts().plan();
    const QString length = shortest(std::round(10 * plan.length) / 10);
    const bool windows = plan.cut == Cut::windows;
    lines["windows"] = windows ? allWindows : "";
    lines["start"] = windows || plan.start == 0 ? "" : shortest(plan.start);
    lines["every"] = plan.cut == Cut::every ? length : "";
    lines["duration"] = plan.cut != Cut::every ? length : plan.stretch ? shortest(*plan.stretch) : "";
    const LogRollouts::Bound& bound = overlay.rollouts().bound();
    // As people read it: a number of the window's boxes has been divided and is multiplied again.
    const auto read = [&](double number) { return bound.fromNetwork ? "" : shortest(std::round(1e6 * number) / 1e6); };
    lines["position"] = read(100 * bound.at.position);
    lines["heading"] = read(degrees * bound.at.heading);
}

/// What is open, as the lines of the dialogues have it.
std::map<QString, QString> linesOf(const Overlay& overlay) {
    std::map<QString, QString> lines;
    if (!overlay.rollouts().log()) return lines;
    const PlayedLog& world = *overlay.rollouts().log();
    lines["log"] = qtText(world.place);
    lines["scenario"] = qtText(world.request.scenario);
    lines["robot"] = qtText(world.request.robotFile);
    QStringList networks, robots;
    for (const JudgedModel& model : overlay.models().all()) networks << networkFile(model);
    lines["network"] = networks.takeFirst();
    networks.removeAll({});
    lines["against"] = lines["models"] = networks.join(", ");
    for (const std::string& robot : world.request.robots) robots << qtText(robot);
    lines["robots"] = robots.join(',');
    addPlan(lines, overlay);
    return lines;
}

/// All but what was written by hand.
void fillIn(const Exports& exports, const ReportDialog& dialog) {
    for (const auto& [name, text] : linesOf(exports.overlay))
        if (auto* line = dialog.findChild<QLineEdit*>(name); line != nullptr && !line->isModified())
            line->setText(text);
}

QLineEdit* bareLine(const QString& name, const QString& tip) {
    auto* line = new QLineEdit;
    line->setObjectName(name);
    line->setToolTip(tip);
    return line;
}

QLineEdit* namedLine(const QString& name, const QString& tip) {
    QLineEdit* line = bareLine(name, tip);
    line->setPlaceholderText(tip);
    line->setMinimumWidth(lineWidth);
    return line;
}

ReportDialog* shownAgain(const Exports& exports, const QString& name) {
    auto* dialog = exports.frame.window.findChild<ReportDialog*>(name);
    if (dialog != nullptr) {
        fillIn(exports, *dialog);
        dialog->show();
        dialog->raise();
        dialog->activateWindow();
    }
    return dialog;
}

}  // namespace

ReportDialog::ReportDialog(const Exports& exports, const QString& title, const QString& about)
    : QDialog(&exports.frame.window),
      exports_(exports),
      form_(new QFormLayout),
      replace_(new QCheckBox(tr("&Replace a report that is there"))),
      error_(new QLabel),
      start_(new QPushButton(tr("&Write report"))) {
    setWindowTitle(title);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(20, 18, 20, 16);
    layout->setSpacing(14);
    auto* text = new QLabel(about);
    text->setWordWrap(true);
    layout->addWidget(text);
    form_->setHorizontalSpacing(14);
    form_->setVerticalSpacing(8);
    layout->addLayout(form_);
    layout->addWidget(replace_);
    error_->setObjectName("error");
    error_->setWordWrap(true);
    error_->setMinimumHeight(2 * error_->fontMetrics().lineSpacing());
    error_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    layout->addWidget(error_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    buttons->addButton(start_, QDialogButtonBox::ActionRole);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    connect(start_, &QPushButton::clicked, this, &ReportDialog::start);
    layout->addWidget(buttons);
    start_->setDefault(true);  // of this dialogue, which the button must be in
}

QLineEdit* ReportDialog::addWords(const QString& name, const QString& label, const QString& tip) {
    QLineEdit* line = namedLine(name, tip);
    form_->addRow(label, line);
    return line;
}

QLineEdit* ReportDialog::addPath(const QString& name, const QString& label, Kind kind, const QString& kinds,
                                 const QString& tip) {
    auto* row = new QWidget;
    auto* across = new QHBoxLayout(row);
    across->setContentsMargins(0, 0, 0, 0);
    QLineEdit* line = namedLine(name, tip);
    across->addWidget(line, 1);
    auto* button = new QToolButton;
    button->setText(tr("Choose\u2026"));
    if (kind == Kind::log) {
        // A log is a file or a folder; no dialogue lets choose both.
        auto* menu = new QMenu(button);
        menu->addAction(tr("A &folder\u2026"), this, [this, line, kinds] { choose(line, Kind::folder, kinds); });
        menu->addAction(tr("A fi&le\u2026"), this, [this, line, kinds] { choose(line, Kind::file, kinds); });
        button->setMenu(menu);
        button->setPopupMode(QToolButton::InstantPopup);
    } else {
        connect(button, &QToolButton::clicked, this, [this, line, kind, kinds] { choose(line, kind, kinds); });
    }
    across->addWidget(button);
    form_->addRow(label, row);
    static_cast<QLabel*>(form_->labelForField(row))->setBuddy(line);
    return line;
}

void ReportDialog::addNumbers(const QString& label, const std::vector<NumberLine>& lines) {
    auto* row = new QWidget;
    auto* across = new QHBoxLayout(row);
    across->setContentsMargins(0, 0, 0, 0);
    for (const NumberLine& one : lines) {
        QLineEdit* line = bareLine(one.name, one.tip);
        line->setFixedWidth(numberWidth);
        line->setPlaceholderText(one.nothing);
        across->addWidget(line);
        across->addWidget(new QLabel(one.after));
    }
    across->addStretch(1);
    form_->addRow(label, row);
    static_cast<QLabel*>(form_->labelForField(row))->setBuddy(row->findChild<QLineEdit*>());
}

void ReportDialog::choose(QLineEdit* line, Kind kind, const QString& kinds) {
    const WindowMemory& memory = exports_.frame.memory;
    const QString from = !line->text().isEmpty() ? line->text()
                         : kind == Kind::folder  ? memory.saveFolder()
                                                 : memory.lastFolder();
    const QString chosen = kind == Kind::folder ? QFileDialog::getExistingDirectory(this, tr("Choose"), from)
                                                : QFileDialog::getOpenFileName(this, tr("Choose"), from, kinds);
    if (chosen.isEmpty()) return;
    if (kind == Kind::folder) exports_.frame.memory.keepSaveFolder(chosen);
    line->setText(chosen);
    line->setModified(true);
}

bool ReportDialog::replaces() const { return replace_->isChecked(); }

void ReportDialog::start() {
    const auto begun = run_();
    error_->setStyleSheet(warningStyle(*this));
    error_->setText(begun ? QString() : qtText(begun.error().message()));
    if (begun) hide();
}

namespace {

// What both ask for.

QLineEdit* addLog(ReportDialog& dialog) {
    return dialog.addPath("log", QObject::tr("&Log"), ReportDialog::Kind::log,
                          QObject::tr("Logs (*.csv);;All files (*)"), QObject::tr("A folder of MRCLAM, or a CSV file"));
}

QLineEdit* addFolder(ReportDialog& dialog) {
    return dialog.addPath("folder", QObject::tr("&Folder"), ReportDialog::Kind::folder, QString(),
                          QObject::tr("Where report.html and its tables go; made if need be"));
}

/// A number that may be left out. Error: it is none, or out of range.
Expected<std::optional<double>> numberIn(const ReportDialog& dialog, const char* name, double least, double most) {
    const auto* line = dialog.findChild<QLineEdit*>(name);
    const QString text = line->text().trimmed();
    if (text.isEmpty()) return std::optional<double>{};
    bool number = false;
    const double value = text.toDouble(&number);
    if (number && value >= least && value <= most) return std::optional<double>(value);
    return fail("", '"' + text.toStdString() + "\" makes no sense there; expected a number from " +
                        shortest(least).toStdString() + " to " + shortest(most).toStdString() + ": " +
                        line->toolTip().toStdString());
}

/// What the comparison's dialogue asks for, as the flags of `mrose compare` do.
Expected<CompareRequest> comparisonIn(const ReportDialog& dialog, const PlayedLogPointer& open) {
    const auto line = [&](const char* name) { return dialog.findChild<QLineEdit*>(name); };
    CompareRequest what{textOf(line("scenario")), textOf(line("log"))};
    what.robots = listFrom(line("robots"));
    what.robotFile = textOf(line("robot"));
    what.windows = textOf(line("windows"));
    if (open && open->place == what.log) what.seed = open->request.seed;
    what.divergence.models = listFrom(line("models"));
    std::optional<double> start, heading, position;
    constexpr double longest = 1e7;  // s
    struct Asked {
        const char* name;
        std::optional<double>& number;
        double least, most;
    };
    for (const Asked& asked : {Asked{"start", start, 0, longest}, Asked{"duration", what.duration, 0.1, longest},
                               Asked{"every", what.every, 0.1, longest}, Asked{"position", position, 0.01, 1e6},
                               Asked{"heading", heading, 0.01, 180}}) {
        auto number = numberIn(dialog, asked.name, asked.least, asked.most);
        if (!number) return tl::unexpected(number.error());
        asked.number = *number;
    }
    if (!what.scenario.empty() && !what.robotFile.empty())
        return fail("", "a scenario says what drove: leave out the robot file, or the scenario");
    if (!what.windows.empty() && (start || what.every))
        return fail("", "windows begin where they are: leave out where to begin and how often");
    what.start = start.value_or(0);
    if (position) what.divergence.position = *position / 100;
    what.divergence.heading = heading;
    return what;
}

}  // namespace

ReportDialog* showReportDialog(const Exports& exports) {
    if (auto* dialog = shownAgain(exports, "report_dialog")) return dialog;
    auto* dialog = new ReportDialog(exports, QObject::tr("Report of a log and a network"),
                                    QObject::tr("How well a network predicts what the robots of a log did, as "
                                                "`mrose evaluate` says it."));
    dialog->setObjectName("report_dialog");
    using Kind = ReportDialog::Kind;
    const auto* log = addLog(*dialog);
    const auto* network = dialog->addPath("network", QObject::tr("&Network"), Kind::file,
                                          QObject::tr("Networks (*.net);;All files (*)"), QObject::tr("A .net file"));
    const auto* against = dialog->addWords("against", QObject::tr("&Beside it"),
                                           QObject::tr("Other networks, with commas between them; or nothing"));
    const auto* robots =
        dialog->addWords("robots", QObject::tr("Ro&bots"), QObject::tr("Of the log, as 1,2; empty: all"));
    const auto* folder = addFolder(*dialog);
    dialog->setAction([=, &exports]() -> Expected<void> {
        if (auto all = needed({{log, "a log"}, {network, "a network"}, {folder, "a folder"}}); !all) return all;
        EvaluateRequest request{textOf(network), textOf(log), listFrom(robots), listFrom(against)};
        return exportReport(exports, request, folder->text().trimmed(), dialog->replaces());
    });
    fillIn(exports, *dialog);
    dialog->show();
    return dialog;
}

ReportDialog* showComparisonDialog(const Exports& exports) {
    if (auto* dialog = shownAgain(exports, "comparison_dialog")) return dialog;
    auto* dialog = new ReportDialog(exports, QObject::tr("Report of a log and a scenario"),
                                    QObject::tr("Simulated robots beside the real ones whose log they play, as "
                                                "`mrose compare` says it."));
    dialog->setObjectName("comparison_dialog");
    using Kind = ReportDialog::Kind;
    dialog->addPath("scenario", QObject::tr("&Scenario"), Kind::file, QObject::tr("Scenarios (*.toml);;All files (*)"),
                    QObject::tr("One whose robots play a log; empty: one that is made for the log"));
    const auto* log = addLog(*dialog);
    dialog->addPath("robot", QObject::tr("Robo&t file"), Kind::file, QObject::tr("Robots (*.toml);;All files (*)"),
                    QObject::tr("What drove, where the log does not say it"));
    dialog->addWords("robots", QObject::tr("Ro&bots"), QObject::tr("Of the log, as 1,2; empty: all that are played"));
    dialog->addNumbers(
        QObject::tr("Again &every"),
        {{"every", QObject::tr("once"), QObject::tr("s, from"),
          QObject::tr("s, from the real robots; empty: one rollout")},
         {"start", "0", QObject::tr("s on, for"), QObject::tr("s after the log's start, where to begin")},
         {"duration", QObject::tr("end"), QObject::tr("s"),
          QObject::tr("s, how long; empty: to the log's end, or what the scenario says")}});
    dialog->addWords("windows", QObject::tr("W&indows"),
                     QObject::tr("Instead: all, as mrose evaluate cuts the log; or a CSV file"));
    dialog->addNumbers(
        QObject::tr("Bou&nd"),
        {{"position", QObject::tr("as robots differ"), QObject::tr("cm or"),
          QObject::tr("cm: farther off it has left the trajectory of the log; empty: what the robots' networks "
                      "know of how runs differ")},
         {"heading", QObject::tr("as robots differ"), QString::fromUtf8("\u00b0"),
          QObject::tr("degrees: turned by more it has left the trajectory of the log; empty: what the robots' "
                      "networks know of how runs differ")}});
    dialog->addWords("models", QObject::tr("&Models"),
                     QObject::tr("Networks that may explain it, beside those that ship; or nothing"));
    const auto* folder = addFolder(*dialog);
    dialog->setAction([=, &exports]() -> Expected<void> {
        if (auto all = needed({{log, "a log"}, {folder, "a folder"}}); !all) return all;
        const auto report = comparisonIn(*dialog, exports.overlay.rollouts().log());
        if (!report) return tl::unexpected(report.error());
        return exportComparison(exports, *report, folder->text().trimmed(), dialog->replaces());
    });
    fillIn(exports, *dialog);
    dialog->show();
    return dialog;
}

}  // namespace mrose::gui
