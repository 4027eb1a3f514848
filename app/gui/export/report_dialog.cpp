#include "export/report_dialog.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <filesystem>
#include <map>

#include "export/report_export.h"
#include "reality/overlay.h"
#include "shared/resources.h"
#include "widgets/warning_style.h"
#include "window/main_window.h"
#include "window/window_memory.h"

namespace mrose::gui {
namespace {

constexpr int lineWidth = 380;

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
QString networkFile(const OverlayWorld& world, const std::string& model) {
    if (!model.ends_with(".net")) return {};
    for (const std::string& named : world.request.models)
        if (std::filesystem::path(named).filename() == model && std::filesystem::exists(named))
            return QString::fromStdString(named);
    const std::filesystem::path shipped = resourceFolder() / "nets" / model;
    return std::filesystem::exists(shipped) ? QString::fromStdString(shipped.string()) : QString();
}

/// What is open, as the lines of the dialogues have it.
std::map<QString, QString> linesOf(const Overlay& overlay) {
    std::map<QString, QString> lines;
    if (!overlay.world()) return lines;
    const OverlayWorld& world = *overlay.world();
    lines["log"] = QString::fromStdString(world.place);
    if (!world.request.scenario.empty())
        lines["scenario"] = QString::fromStdString(world.request.scenario);
    else if (world.world().log().format == "mrclam")
        lines["scenario"] = "mrclam_replay.toml";
    QStringList networks, robots;
    for (const OverlayModel& model : overlay.models()) networks << networkFile(world, model.name);
    lines["network"] = networks.takeFirst();
    networks.removeAll({});
    lines["against"] = networks.join(", ");
    for (const std::string& robot : world.request.robots) robots << QString::fromStdString(robot);
    lines["robots"] = robots.join(',');
    if (overlay.plan().cut == OverlayPlan::Cut::every) lines["every"] = QString::number(overlay.plan().length);
    return lines;
}

/// All but what somebody has written.
void fillIn(const MainWindow& window, const ReportDialog& dialog) {
    for (const auto& [name, text] : linesOf(window.overlay()))
        if (auto* line = dialog.findChild<QLineEdit*>(name); line != nullptr && !line->isModified())
            line->setText(text);
}

QLineEdit* namedLine(const QString& name, const QString& tip) {
    auto* line = new QLineEdit;
    line->setObjectName(name);
    line->setPlaceholderText(tip);
    line->setToolTip(tip);
    line->setMinimumWidth(lineWidth);
    return line;
}

ReportDialog* shownAgain(MainWindow& window, const QString& name) {
    auto* dialog = window.findChild<ReportDialog*>(name);
    if (dialog != nullptr) {
        fillIn(window, *dialog);
        dialog->show();
        dialog->raise();
        dialog->activateWindow();
    }
    return dialog;
}

}  // namespace

ReportDialog::ReportDialog(MainWindow& window, const QString& title, const QString& about)
    : QDialog(&window),
      window_(window),
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

void ReportDialog::choose(QLineEdit* line, Kind kind, const QString& kinds) {
    const QString from = line->text().isEmpty() ? window_.memory().lastFolder() : line->text();
    const QString chosen = kind == Kind::folder ? QFileDialog::getExistingDirectory(this, tr("Choose"), from)
                                                : QFileDialog::getOpenFileName(this, tr("Choose"), from, kinds);
    if (chosen.isEmpty()) return;
    line->setText(chosen);
    line->setModified(true);
}

bool ReportDialog::replaces() const { return replace_->isChecked(); }

void ReportDialog::start() {
    const auto begun = run_();
    error_->setStyleSheet(warningStyle(*this));
    error_->setText(begun ? QString() : QString::fromStdString(begun.error().message()));
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

}  // namespace

ReportDialog* showReportDialog(MainWindow& window) {
    if (auto* dialog = shownAgain(window, "report_dialog")) return dialog;
    auto* dialog = new ReportDialog(window, QObject::tr("Report of a log and a network"),
                                    QObject::tr("How well a network foretells what the robots of a log did, as "
                                                "`mrose evaluate` says it."));
    dialog->setObjectName("report_dialog");
    using Kind = ReportDialog::Kind;
    const auto* log = addLog(*dialog);
    const auto* network = dialog->addPath("network", QObject::tr("&Network"), Kind::file,
                                          QObject::tr("Networks (*.net);;All files (*)"), QObject::tr("A .net file"));
    const auto* against = dialog->addWords("against", QObject::tr("&Beside it"),
                                           QObject::tr("Other networks, with commas between them; or nothing"));
    const auto* robots =
        dialog->addWords("robots", QObject::tr("Ro&bots"), QObject::tr("Of the log, as 1,2; nothing: all"));
    const auto* folder = addFolder(*dialog);
    dialog->setAction([=, &window]() -> Expected<void> {
        if (auto all = needed({{log, "a log"}, {network, "a network"}, {folder, "a folder"}}); !all) return all;
        LogEvaluationRequest request{textOf(network), textOf(log), listFrom(robots), listFrom(against)};
        return exportReport(window, request, folder->text().trimmed(), dialog->replaces());
    });
    fillIn(window, *dialog);
    dialog->show();
    return dialog;
}

ReportDialog* showComparisonDialog(MainWindow& window) {
    if (auto* dialog = shownAgain(window, "comparison_dialog")) return dialog;
    auto* dialog = new ReportDialog(window, QObject::tr("Report of a log and a scenario"),
                                    QObject::tr("Simulated robots beside the real ones whose log they play, as "
                                                "`mrose compare` says it."));
    dialog->setObjectName("comparison_dialog");
    using Kind = ReportDialog::Kind;
    const auto* scenario = dialog->addPath(
        "scenario", QObject::tr("&Scenario"), Kind::file, QObject::tr("Scenarios (*.toml);;All files (*)"),
        QObject::tr("One whose robots play a log; nothing: one that is made for the log"));
    const auto* log = addLog(*dialog);
    const auto* robots = dialog->addWords("robots", QObject::tr("Ro&bots"),
                                          QObject::tr("Of the log, as 1,2; nothing: all that are played"));
    const auto* every = dialog->addWords("every", QObject::tr("Again &every (s)"),
                                         QObject::tr("From where the real robots are; nothing: one course"));
    const auto* folder = addFolder(*dialog);
    dialog->setAction([=, &window]() -> Expected<void> {
        if (auto all = needed({{log, "a log"}, {folder, "a folder"}}); !all) return all;
        LogComparisonRequest request{textOf(scenario), textOf(log)};
        request.robots = listFrom(robots);
        if (const OverlayWorldPointer& open = window.overlay().world(); open && open->place == request.log)
            request.robotFile = open->request.robotFile;
        if (!every->text().trimmed().isEmpty()) {
            bool number = false;
            const double seconds = every->text().trimmed().toDouble(&number);
            if (!number || !(seconds >= 0.1 && seconds <= 1e7))
                return fail(
                    "", "starting again every \"" + textOf(every) + "\" s makes no sense; expected 0.1 at the least");
            request.every = seconds;
        }
        return exportComparison(window, request, folder->text().trimmed(), dialog->replaces());
    });
    fillIn(window, *dialog);
    dialog->show();
    return dialog;
}

}  // namespace mrose::gui
