#include "reality/cause_panel.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/divergence_text.h"
#include "io/format.h"
#include "reality/folding_lines.h"
#include "widgets/eliding_text.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"
#include "widgets/whole_rows.h"

namespace mrose::gui {
namespace {

constexpr int explainedRole = Qt::UserRole;
/// So many lines are seen at once.
constexpr int shownLines = 4, shownLinesWhereLow = 3;
constexpr int narrowWords = 420, narrowestWords = 330, narrowBound = 470;  // pixels
constexpr int barWidth = 30, numberWidth = 44;                             // pixels

/// A share as a bar with its number.
class ShareBar final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        QStyledItemDelegate::paint(painter, option, index);
        const double share = index.data(explainedRole).toDouble();
        const double line = option.fontMetrics.height() + 5, middle = option.rect.center().y() + 0.5;
        QRectF room(option.rect.left() + 4, middle - line / 2 + 4, option.rect.width() - 4 - numberWidth, line - 8);
        QColor colour = option.palette.color(QPalette::Link);
        colour.setAlphaF(0.25);
        painter->fillRect(room, colour);
        room.setWidth(room.width() * std::clamp(share, 0.0, 1.0));
        colour.setAlphaF(1);
        painter->fillRect(room, colour);
    }
};

/// A name in as many lines as it needs.
class WrappedName final : public QStyledItemDelegate {
public:
    using QStyledItemDelegate::QStyledItemDelegate;

    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        constexpr int margins = 8, spare = 2;  // pixels: of a column, of each further line
        QStyleOptionViewItem of = option;
        initStyleOption(&of, index);
        const QSize one = QStyledItemDelegate::sizeHint(option, index);
        const auto* const view = qobject_cast<const QTreeView*>(option.widget);
        if (view == nullptr) return one;
        const QRect room(0, 0, view->columnWidth(index.column()) - margins, QWIDGETSIZE_MAX);
        const int height = of.fontMetrics.boundingRect(room, Qt::TextWordWrap, of.text).height();
        const int more = std::max(0, height - of.fontMetrics.height());
        return {one.width(), one.height() + more + spare * (more / std::max(1, of.fontMetrics.lineSpacing()))};
    }
};

/// How far it is off.
QString offText(const RolloutRow& row) {
    if (!row.position) return QObject::tr("no ground truth here");
    const QString position = fixedText(100 * *row.position, 1) + " cm";
    if (!row.heading) return QObject::tr("%1 off on average where the ground truth is known").arg(position);
    return QObject::tr("%1, %2\u00b0 off on average").arg(position, fixedText(degrees * *row.heading, 1));
}

/// "2.0 to 6.1 cm, 11.8 deg", with the sign of a degree.
QString inForceText(const DivergenceBound& bound) {
    double low = bound.at(0).position, high = low, left = bound.at(0).heading, right = left;
    for (const DivergenceBound::At& at : bound.bySteps) {
        low = std::min(low, at.position);
        high = std::max(high, at.position);
        left = std::min(left, at.heading);
        right = std::max(right, at.heading);
    }
    const auto range = [](double least, double most) {
        const QString from = fixedText(least, 1), to = fixedText(most, 1);
        return from == to ? from : QObject::tr("%1 to %2").arg(from, to);
    };
    return QObject::tr("%1 cm, %2\u00b0").arg(range(100 * low, 100 * high), range(degrees * left, degrees * right));
}

QDoubleSpinBox* boundBox(const char* suffix, double most, const QString& tip) {
    auto* box = new QDoubleSpinBox;
    box->setRange(0.1, most);
    box->setDecimals(1);
    box->setSuffix(QString::fromUtf8(suffix));
    box->setKeyboardTracking(false);
    box->setToolTip(tip);
    return box;
}

}  // namespace

CausePanel::CausePanel(Overlay& overlay, QWidget* parent)
    : QWidget(parent),
      overlay_(overlay),
      rollout_(new ElidingText(1)),
      divergence_(new ElidingText(2)),
      onset_(new ElidingText(3)),
      cause_(new ElidingText(2)),
      goThere_(new QToolButton),
      speeds_(new QToolButton),
      causes_(new WholeRows<QTreeWidget>) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    QFont bold = rollout_->font();
    bold.setBold(true);
    rollout_->setFont(bold);
    cause_->setFont(bold);
    layout->addWidget(rollout_);
    auto* where = new QHBoxLayout;
    goThere_->setText(tr("Go there"));
    goThere_->setToolTip(tr("To the instant at which it leaves the trajectory of the log (D)"));
    connect(goThere_, &QToolButton::clicked, this, [this] { overlay_.shown().goToDivergence(); });
    for (QWidget* part : {static_cast<QWidget*>(goThere_), static_cast<QWidget*>(causes_)}) {
        QSizePolicy policy = part->sizePolicy();
        policy.setRetainSizeWhenHidden(true);
        part->setSizePolicy(policy);
    }
    why_ = new QWidget;
    auto* why = new QVBoxLayout(why_);
    why->setContentsMargins(0, 0, 0, 0);
    why->setSpacing(layout->spacing());
    why->addWidget(onset_);
    why->addWidget(cause_);
    why->addWidget(causes_);
    why_->hide();
    where->addWidget(divergence_, 1);
    where->addWidget(goThere_, 0, Qt::AlignTop);
    layout->addLayout(where);
    makeCauses();
    layout->addWidget(why_);
    layout->addWidget(makeBound());
}

QWidget* CausePanel::makeBound() {
    auto* bound = new QWidget;
    boundLines_ = new QBoxLayout(QBoxLayout::TopToBottom, bound);
    boundLines_->setContentsMargins(0, 0, 0, 0);
    boundLines_->setSpacing(4);
    auto *layout = new QHBoxLayout, *below = new QHBoxLayout;
    boundLines_->addLayout(layout);
    boundLines_->addLayout(below);
    position_ =
        boundBox(" cm", 1000, tr("It has left the trajectory of the log when it is farther off than this for 0.3 s"));
    heading_ = boundBox("\u00b0", 180,
                        tr("It has left the trajectory of the log when it is turned by more than this for 0.3 s"));
    learned_ = new QCheckBox(tr("as robots differ"));
    learned_->setToolTip(
        tr("What 99 of 100 runs of such a robot keep to, by the noise of its network; of a network that does not "
           "know it, three times what its errors on held-out logs make of the path and rotation so far"));
    inForce_ = new QLabel;
    inForce_->setToolTip(
        tr("From the rollout's start to its end; farther off for 0.3 s it has left the "
           "trajectory of the log"));
    layout->addWidget(new QLabel(tr("Bound")));
    layout->addWidget(position_);
    layout->addWidget(heading_);
    layout->addWidget(inForce_);
    layout->addStretch(1);
    below->addWidget(learned_);
    below->addStretch(1);
    below->addWidget(speeds_);
    connect(position_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &CausePanel::applyBound);
    connect(heading_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &CausePanel::applyBound);
    connect(learned_, &QCheckBox::toggled, this, &CausePanel::applyBound);
    return bound;
}

void CausePanel::makeCauses() {
    causes_->setObjectName("causes");
    causes_->setAccessibleName(tr("Likely causes, and how much of the error each explains"));
    causes_->setHeaderLabels({tr("Changed in a re-run"), tr("explains")});
    causes_->setRootIsDecorated(false);
    causes_->setIndentation(0);
    causes_->setWordWrap(true);
    causes_->setFrameShape(QFrame::NoFrame);
    causes_->header()->setStretchLastSection(false);
    causes_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    causes_->header()->setSectionResizeMode(1, QHeaderView::Fixed);
    causes_->header()->resizeSection(1, barWidth + 4 + numberWidth);
    // A name may need another line now, or one less.
    connect(causes_->header(), &QHeaderView::sectionResized, causes_, [this] { causes_->doItemsLayout(); });
    causes_->setItemDelegateForColumn(1, new ShareBar(causes_));
    causes_->setItemDelegateForColumn(0, new WrappedName(causes_));
    connect(causes_, &QTreeWidget::itemClicked, this, [this](QTreeWidgetItem* item) {
        const auto trial = static_cast<std::size_t>(causes_->indexOfTopLevelItem(item));
        const bool again = overlay_.causes().shown() == trial;
        overlay_.causes().show(again ? std::nullopt : std::optional(trial));
    });
}

void CausePanel::offer(QAction& speeds) {
    speeds_->setDefaultAction(&speeds);
    speeds_->setText(tr("Speeds"));
}

void CausePanel::applyBound() {
    if (filling_) return;
    overlay_.setBound({{position_->value() / 100, heading_->value() / degrees}, learned_->isChecked()});
}

void CausePanel::refresh() {
    const RolloutRow* const row = overlay_.rollouts().shownRow();
    setVisible(row != nullptr);
    filling_ = true;
    position_->setValue(100 * overlay_.rollouts().bound().at.position);
    heading_->setValue(degrees * overlay_.rollouts().bound().at.heading);
    learned_->setChecked(overlay_.rollouts().bound().fromNetwork);
    filling_ = false;
    if (row == nullptr) return;
    // What does not count is not shown.
    position_->setVisible(!learned_->isChecked());
    heading_->setVisible(!learned_->isChecked());
    inForce_->setVisible(learned_->isChecked());
    inForce_->setText(inForceText(row->bound));
    fitLines();
    QString robot = qtText(overlay_.rollouts().world().robots()[row->robot].name);
    if (const std::string session = sessionText(overlay_.rollouts().world().sessions()[row->session]); !session.empty())
        robot += tr(" in %1").arg(qtText(session));
    const QString start = logTimeText(row->start);
    rollout_->setText((overlay_.shown().showsCompared() ? tr("%1 from %2: %3") : tr("%1 from %2 (not this branch): %3"))
                          .arg(robot, start, offText(*row)));
    const auto& divergence = row->divergence;
    goThere_->setVisible(divergence.has_value());
    // From the first that leaves on, nothing moves from rollout to rollout; before, the list has the room.
    if (divergence) whyOf_ = overlay_.rollouts().log();
    why_->setVisible(whyOf_.lock() == overlay_.rollouts().log());
    if (!divergence)
        divergence_->setText(!row->position ? QString()
                             : row->bound.source == BoundSource::noise
                                 ? tr("It stays within what such robots differ from themselves.")
                                 : tr("It stays within the bound."));
    else
        divergence_->setText(
            tr("Leaves the %1 trajectory after %2 s: %3 cm, %4\u00b0")
                .arg(overlay_.rollouts().world().log().real(), fixedText(toSeconds(divergence->time), 1),
                     fixedText(100 * divergence->position, 1), fixedText(degrees * divergence->heading, 1)));
    refreshCauses();
}

/// Where there is little room across words take another line.
void CausePanel::fitLines() {
    const auto& log = overlay_.rollouts().log();
    // Always the same: the list of rollouts above keeps its room.
    const int line = causes_->fontMetrics().height() + 5;
    causes_->setFixedHeight(((low_ ? shownLinesWhereLow : shownLines) + 1) * line + 6);
    layBeside(*boundLines_, width() >= narrowBound);
    rollout_->setLines(width() < narrowWords || (log && log->world().sessions().size() > 1) ? 2 : 1);
    onset_->setLines(width() < narrowestWords ? 5 : width() < narrowWords ? 4 : 3);
    cause_->setLines(width() < narrowWords ? 3 : 2);
}

void CausePanel::setLow(bool low) {
    if (std::exchange(low_, low) != low) refresh();
}

void CausePanel::resizeEvent(QResizeEvent* event) {
    fitLines();
    QWidget::resizeEvent(event);
}

/// The verdict in a line.
QString CausePanel::likely() const {
    const auto& finding = overlay_.causes().finding();
    if (!finding) return {};
    if (!finding->error.isEmpty()) return finding->error;
    if (!finding->diagnosis) return tr("Looking for the cause: %1 %").arg(static_cast<int>(100 * finding->share));
    const Diagnosis& diagnosis = *finding->diagnosis;
    if (diagnosis.trials.empty()) return tr("No re-run could be made");
    const QString explains = qtText(explainedText(diagnosis.trials[diagnosis.likely.value_or(0)]));
    if (!diagnosis.likely) return tr("No likely cause: the best re-run explains %1").arg(explains);
    return tr("Likely cause: %1 (explains %2)").arg(qtText(diagnosis.trials[*diagnosis.likely].what), explains);
}

void CausePanel::refreshCauses() {
    cause_->setText(likely());
    const auto& finding = overlay_.causes().finding();
    const bool known = finding && finding->diagnosis;
    onset_->setText(known ? qtText(onsetText(*finding->diagnosis, overlay_.rollouts().world().log().real()))
                          : QString());
    causes_->setVisible(known);
    causes_->clear();
    if (!known) return;
    const Diagnosis& diagnosis = *finding->diagnosis;
    for (std::size_t i = 0; i < diagnosis.trials.size(); ++i) {
        const CauseTrial& trial = diagnosis.trials[i];
        auto* item = new QTreeWidgetItem({qtText(trial.what), tr("%1 %").arg(std::lround(100 * trial.explained))});
        item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
        item->setData(1, explainedRole, trial.explained);
        item->setToolTip(0, tr("%1. A click lays this re-run beside").arg(item->text(0)));
        if (diagnosis.likely == i) {
            QFont bold = item->font(0);
            bold.setBold(true);
            item->setFont(0, bold);
        }
        causes_->addTopLevelItem(item);
        if (overlay_.causes().shown() == i) item->setSelected(true);
    }
}

QString CausePanel::text() const {
    return QStringList{rollout_->text(), divergence_->text(), onset_->text(), cause_->text()}.join('\n');
}

}  // namespace mrose::gui
