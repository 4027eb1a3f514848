#include "export/film_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

#include "export/film.h"
#include "files/window_files.h"
#include "frame/actions.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"
#include "widgets/timeline_bar.h"
#include "widgets/warning_style.h"

namespace mrose::gui {
namespace {

constexpr double latest = 1e7;  // s
constexpr QSize usualSizes[] = {{1280, 720}, {1920, 1080}, {2560, 1440}, {3840, 2160}};

QDoubleSpinBox* number(double least, double most, double value, int decimals, const QString& suffix) {
    auto* box = new QDoubleSpinBox;
    box->setDecimals(decimals);
    box->setRange(least, most);
    box->setValue(value);
    box->setSuffix(suffix);
    box->setAlignment(Qt::AlignRight);
    return box;
}

QString sizeText(const QSize& size) { return QString::fromUtf8("%1 \u00d7 %2").arg(size.width()).arg(size.height()); }

}  // namespace

FilmDialog::FilmDialog(const Exports& exports, bool film)
    : QDialog(&exports.frame.window),
      exports_(exports),
      kind_(new QComboBox),
      what_(new QComboBox),
      size_(new QComboBox),
      from_(number(0, latest, 0, 2, tr(" s"))),
      to_(number(0, latest, 0, 2, tr(" s"))),
      speed_(number(0.001, 10'000, 1, 3, QString())),
      rate_(number(0.1, 1000, 25, 2, tr(" per s"))),
      summary_(new QLabel),
      export_(new QPushButton(tr("E&xport\u2026"))) {
    setObjectName("film_dialog");
    setWindowTitle(tr("Export a stretch of time"));
    kind_->addItems({tr("Film (MP4)"), tr("Numbered pictures (PNG)")});
    what_->addItems({tr("Field view, as it is shown"), tr("Whole window")});
    speed_->setPrefix(QString::fromUtf8("\u00d7 "));
    speed_->setToolTip(tr("Simulated seconds in a second of the film"));
    rate_->setToolTip(tr("Frames in a second of the film"));
    fill();
    setFilm(film);
    const auto changed = [this] { refresh(); };
    for (QComboBox* box : {kind_, what_, size_}) connect(box, QOverload<int>::of(&QComboBox::activated), this, changed);
    for (QDoubleSpinBox* box : {from_, to_, speed_, rate_})
        connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, changed);
    connect(export_, &QPushButton::clicked, this, &FilmDialog::ask);
    refresh();
}

void FilmDialog::fill() {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(20, 18, 20, 16);
    layout->setSpacing(14);
    auto* form = new QFormLayout;
    form->setHorizontalSpacing(14);
    form->setVerticalSpacing(8);
    const auto time = [this](QDoubleSpinBox* box, const QString& tip) {
        auto* row = new QWidget;
        auto* across = new QHBoxLayout(row);
        across->setContentsMargins(0, 0, 0, 0);
        auto* now = new QToolButton;
        now->setText(tr("now"));
        now->setToolTip(tip);
        connect(now, &QToolButton::clicked, this, [this, box] {
            if (exports_.frame.shown())
                box->setValue(toSeconds(exports_.frame.shown()->frame->scene().timeOf(exports_.frame.shown()->tick())));
        });
        across->addWidget(box, 1);
        across->addWidget(now);
        return row;
    };
    form->addRow(tr("&As"), kind_);
    form->addRow(tr("&Picture"), what_);
    form->addRow(tr("&From"), time(from_, tr("The tick that is shown")));
    form->addRow(tr("&To"), time(to_, tr("The tick that is shown")));
    form->addRow(tr("&Speed"), speed_);
    form->addRow(tr("F&rames"), rate_);
    form->addRow(tr("Si&ze"), size_);
    // A row's label speaks for its field, not for what stands around it.
    for (QDoubleSpinBox* box : {from_, to_})
        static_cast<QLabel*>(form->labelForField(box->parentWidget()))->setBuddy(box);
    layout->addLayout(form);
    summary_->setWordWrap(true);
    summary_->setMinimumWidth(340);
    summary_->setMinimumHeight(2 * summary_->fontMetrics().lineSpacing());
    summary_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    layout->addWidget(summary_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    buttons->addButton(export_, QDialogButtonBox::ActionRole);
    export_->setDefault(true);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    layout->addWidget(buttons);
    if (!exports_.frame.shown()) return;
    const Shown& shown = *exports_.frame.shown();
    const Scene& scene = shown.frame->scene();
    const Nanoseconds first = scene.timeOf(shown.first);
    const Nanoseconds length = shown.frame->scenario->parts().duration;
    from_->setValue(toSeconds(first));
    to_->setValue(toSeconds(shown.last > shown.first ? scene.timeOf(shown.last) : first + length));
}

void FilmDialog::setFilm(bool film) {
    kind_->setCurrentIndex(film ? 0 : 1);
    refresh();
}

SequenceSettings FilmDialog::settings() const {
    SequenceSettings settings;
    settings.from = from_->value();
    settings.to = to_->value();
    settings.framesPerSecond = rate_->value();
    settings.speed = speed_->value();
    settings.size = size_->currentData().toSize();
    settings.wholeWindow = what_->currentIndex() == 1;
    return settings;
}

/// What would come of it.
void FilmDialog::refresh() {
    const QSize shown = what_->currentIndex() == 1 ? exports_.frame.window.size() : exports_.field.size();
    const int chosen = std::max(0, size_->currentIndex());
    size_->clear();
    size_->addItem(tr("as shown: %1").arg(sizeText(shown)), QSize());
    for (const QSize& size : usualSizes) size_->addItem(sizeText(size), size);
    size_->setCurrentIndex(chosen);
    const Nanoseconds tick = exports_.frame.shown() ? exports_.frame.shown()->frame->scene().tickLength : 1;
    const auto ticks = sequenceTicks(settings(), tick);
    export_->setEnabled(ticks.has_value() && exports_.frame.shown());
    if (!ticks) return say(qtText(ticks.error().message()), true);
    if (const auto can = checkEncoder(); kind_->currentIndex() == 0 && !can) {
        export_->setEnabled(false);
        return say(qtText(can.error().message()), true);
    }
    const auto count = static_cast<double>(ticks->size());
    const QString frames = ticks->size() == 1 ? tr("one frame") : tr("%1 frames").arg(ticks->size());
    say(kind_->currentIndex() == 0 ? tr("%1, a film of %2 s").arg(frames).arg(count / rate_->value(), 0, 'f', 2)
                                   : frames,
        false);
}

void FilmDialog::say(const QString& text, bool wrong) {
    summary_->setStyleSheet(wrong ? warningStyle(*this) : QString());
    summary_->setText(text);
}

bool FilmDialog::exportTo(const QString& path) {
    const bool film = kind_->currentIndex() == 0;
    const auto begun = film ? exportFilm(exports_, path, settings()) : exportFrames(exports_, path, settings());
    if (begun)
        close();
    else
        say(qtText(begun.error().message()), true);
    return begun.has_value();
}

void FilmDialog::ask() {
    const bool film = kind_->currentIndex() == 0;
    const QString path =
        exports_.files.saver().askForName(*this, film ? tr("Export film") : tr("Export pictures into a new folder"),
                                          film ? tr("Films (*.mp4)") : tr("Folders (*)"), film ? ".mp4" : "_pictures");
    if (!path.isEmpty()) exportTo(path);
}

FilmDialog* showFilmDialog(const Exports& exports, bool film) {
    auto* dialog = exports.frame.window.findChild<FilmDialog*>();
    if (dialog == nullptr) {
        dialog = new FilmDialog(exports, film);
        dialog->setAttribute(Qt::WA_DeleteOnClose);
    }
    dialog->setFilm(film);
    dialog->show();
    dialog->raise();
    dialog->activateWindow();
    return dialog;
}

}  // namespace mrose::gui
