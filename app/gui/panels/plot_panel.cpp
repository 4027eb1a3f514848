#include "panels/plot_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "panels/curve_list.h"
#include "widgets/curve_sampling.h"
#include "widgets/eliding_label.h"
#include "widgets/qt_text.h"
#include "widgets/timeline_glyphs.h"

namespace mrose::gui {
namespace {

constexpr int mostSideWidth = 336, leastSideWidth = 150;
constexpr double mostSideShare = 0.4;
constexpr int levelDecimals = 1;
constexpr QSize leastPlot(140, 90);       // pixels
constexpr std::int64_t worthABar = 2000;  // ticks to be computed

const Reality* realityOf(const std::shared_ptr<const Shown>& shown) {
    return shown ? shown->frame->reality.get() : nullptr;
}

QFont smallOf(QFont font) {
    font.setPointSizeF(std::min(8.5, font.pointSizeF()));
    return font;
}

PlotCurve curveOf(const ValueSeries& known, const ValueKey& key, const PlottedValue& value,
                  const std::vector<BranchTicks>& lineage) {
    PlotCurve curve;
    curve.id = qtText(key.quantity + '\n' + key.body + '\n' + key.of);
    curve.name = qtText(value.name);
    curve.unit = qtText(value.unit);
    curve.decimals = value.decimals;
    const ValueSeries* series = &known;
    curve.sample = [series, key, lineage, angle = value.angle](std::int64_t from, std::int64_t to, std::int64_t step,
                                                               QVector<QPointF>& points) {
        for (const BranchTicks& part : lineage)
            if (const TickNumbers* const numbers = series->find(part.branch, key))
                sampleCurve(*numbers, std::max(from, part.first), std::min(to, part.last), step, angle, points);
    };
    curve.at = [series, key, lineage](std::int64_t tick) {
        double found = std::numeric_limits<double>::quiet_NaN();
        for (const BranchTicks& part : lineage)
            if (tick >= part.first && tick <= part.last)
                if (const TickNumbers* const numbers = series->find(part.branch, key))
                    found = static_cast<double>(numbers->at(tick));
        return found;
    };
    return curve;
}

std::vector<PlottedValue> valuesOf(const std::shared_ptr<const Shown>& shown, const std::vector<ValueKey>& keys) {
    std::vector<PlottedValue> values;
    if (shown)
        for (const ValueKey& key : keys)
            values.push_back(plottedValue(*shown->frame->scenario, key).value_or(PlottedValue{}));
    return values;
}

}  // namespace

PlotPanel::PlotPanel(Session& session, QWidget* parent)
    : QWidget(parent),
      series_(std::make_unique<SeriesWorker>(session)),
      view_(new PlotView),
      area_(new QScrollArea),
      hint_(new QLabel(tr("Nothing is plotted. Click the small curve beside a number in the inspector, or write an "
                          "expression at the right."))),
      list_(new CurveList(smallOf(font()))),
      ghostNote_(new ElidingLabel),
      expression_(new QLineEdit),
      error_(new QLabel),
      progress_(new QWidget),
      bar_(new QProgressBar) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(hint_, 1);
    area_->setWidget(view_);
    area_->setWidgetResizable(true);
    area_->setFrameShape(QFrame::NoFrame);
    area_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    area_->setFocusPolicy(Qt::NoFocus);
    area_->setMinimumSize(leastPlot);
    layout->addWidget(area_, 1);
    layout->addWidget(makeSide());
    hint_->setAlignment(Qt::AlignCenter);
    hint_->setWordWrap(true);
    connect(view_, &PlotView::tickRequested, this, &PlotPanel::tickRequested);
    connect(view_, &PlotView::hovered, this, [this](std::optional<std::int64_t> tick) {
        hovered_ = tick;
        updateNumbers();
    });
    connect(series_.get(), &SeriesWorker::grown, this, [this] {
        view_->refreshSoon();
        updateNumbers();
        updateProgress();
    });
    rebuild();
}

PlotPanel::~PlotPanel() = default;

QWidget* PlotPanel::makeSide() {
    auto* side = new QWidget;
    side_ = side;
    const QFont small = smallOf(font());
    side->setFont(small);
    auto* layout = new QVBoxLayout(side);
    layout->setContentsMargins(4, 2, 6, 4);
    layout->setSpacing(3);
    connect(list_, &CurveList::removalWanted, this, [this](int line) {
        if (line < static_cast<int>(keys_.size())) remove(ValueKey(keys_[static_cast<std::size_t>(line)]));
    });
    connect(list_, &CurveList::clearWanted, this, &PlotPanel::clear);
    layout->addWidget(list_, 1);
    layout->addWidget(ghostNote_);
    auto* bar = new QHBoxLayout(progress_);
    bar->setContentsMargins(0, 0, 0, 0);
    ghostNote_->setToolTip(tr("The thin curves are the other branch's, with which this one is compared"));
    bar_->setTextVisible(true);
    bar_->setFormat(tr("the past: %p %"));
    bar_->setFixedHeight(16);
    auto* stop = new QToolButton;
    stop->setText(tr("Stop"));
    stop->setToolTip(tr("Leave out what has not been computed of the past"));
    connect(stop, &QToolButton::clicked, this, &PlotPanel::cancel);
    bar->addWidget(bar_, 1);
    bar->addWidget(stop);
    progress_->hide();
    layout->addWidget(progress_);
    error_->setWordWrap(false);
    error_->hide();
    layout->addWidget(error_);
    expression_->setFont(small);
    expression_->setPlaceholderText(tr("Expression"));
    expression_->setToolTip(
        tr("A number of the world to plot, such as robot[2].speed, robot[\"red 1\"].x or "
           "distance(robot[2], ball); Enter plots it"));
    expression_->setAccessibleName(tr("Expression to plot"));
    connect(expression_, &QLineEdit::returnPressed, this, [this] {
        if (addExpression(expression_->text())) expression_->clear();
    });
    connect(expression_, &QLineEdit::textEdited, error_, &QLabel::hide);
    layout->addWidget(expression_);
    return side;
}

void PlotPanel::setTheme(const Theme& theme) {
    theme_ = theme;
    QPalette palette = error_->palette();
    palette.setColor(QPalette::WindowText, theme.warning);
    error_->setPalette(palette);
    palette.setColor(QPalette::WindowText, theme.quietText);
    hint_->setPalette(palette);
    ghostNote_->setPalette(palette);
    view_->setTheme(theme);
    rebuild();
    emit changed();
}

void PlotPanel::cancel() {
    series_->cancel();
    view_->refresh();
    updateProgress();
}

void PlotPanel::settle() {
    series_->settle();
    view_->draw();
    updateNumbers();
}

void PlotPanel::askForExpression() {
    expression_->setFocus(Qt::ShortcutFocusReason);
    expression_->selectAll();
}

Expected<void> PlotPanel::add(const ValueKey& wanted) {
    if (!shown_) return fail({}, "nothing is open");
    ValueKey key = wanted;
    const Scenario& scenario = *shown_->frame->scenario;
    if (const auto bound = boundValue(scenario, key); bound && bound->quantity == &partQuantity()) {
        auto unit = entryUnit(scenario, *bound);
        if (!unit) return tl::unexpected(unit.error());
        if (key.unit.empty()) key.unit = std::move(*unit);
    }
    if (auto value = plottedValue(*shown_->frame->scenario, key); !value) return tl::unexpected(value.error());
    if (std::find(keys_.begin(), keys_.end(), key) != keys_.end()) return {};
    keys_.push_back(key);
    rebuild();
    emit changed();
    emit asked();
    return {};
}

Expected<void> PlotPanel::addExpression(const QString& text) {
    const std::string typed = text.trimmed().toStdString();
    const std::optional<ValueKey> plain = shown_ ? keyOfPath(*shown_->frame->scenario, typed) : std::nullopt;
    Expected<void> added = add(plain.value_or(ValueKey{expressionQuantity, {}, typed}));
    error_->setVisible(!added);
    if (added) return added;
    const QString message = qtText(added.error().message());
    error_->setText(error_->fontMetrics().elidedText(message, Qt::ElideRight, side_->width() - 14));
    error_->setToolTip(message);
    return added;
}

void PlotPanel::toggle(const ValueKey& key) {
    if (std::find(keys_.begin(), keys_.end(), key) != keys_.end())
        remove(key);
    else
        add(key);
}

void PlotPanel::toggleOfAll(const ValueKey& key) {
    if (!shown_) return;
    std::vector<ValueKey> all;
    for (const SceneRobot& robot : shown_->frame->scene().robots)
        if (robot.name != key.of) all.push_back({key.quantity, robot.name, key.of, key.unit});
    toggleAll(std::move(all));
}

void PlotPanel::toggleAll(std::vector<ValueKey> all) {
    const auto isPlotted = [&](const ValueKey& one) {
        return std::find(keys_.begin(), keys_.end(), one) != keys_.end();
    };
    const bool removes = std::all_of(all.begin(), all.end(), isPlotted);
    if (removes) {
        std::erase_if(keys_, [&](const ValueKey& one) { return std::find(all.begin(), all.end(), one) != all.end(); });
    } else {
        std::erase_if(all, isPlotted);
        keys_.insert(keys_.end(), all.begin(), all.end());
    }
    rebuild();
    emit changed();
    if (!removes) emit asked();
}

void PlotPanel::replace(const std::vector<ValueKey>& some, const std::vector<ValueKey>& others) {
    const auto within = [](const std::vector<ValueKey>& keys) {
        return [&keys](const ValueKey& one) { return std::find(keys.begin(), keys.end(), one) != keys.end(); };
    };
    const auto moves = [&](const ValueKey& one) { return within(some)(one) || within(others)(one); };
    const auto first = std::find_if(keys_.begin(), keys_.end(), within(some));
    const auto before = first == keys_.end() ? 0 : first - keys_.begin();
    std::vector<ValueKey> keys;
    std::remove_copy_if(keys_.begin(), keys_.begin() + before, std::back_inserter(keys), moves);
    keys.insert(keys.end(), others.begin(), others.end());
    std::remove_copy_if(keys_.begin() + before, keys_.end(), std::back_inserter(keys), moves);
    if (keys == keys_) return;
    keys_ = std::move(keys);
    rebuild();
    emit changed();
}

void PlotPanel::setForesight(Foresight foresight) {
    if (foresight == foresight_) return;
    foresight_ = std::move(foresight);
    rebuild();
}

/// Of the shown run.
const PlotPanel::Foresight* PlotPanel::foresight() const {
    return shown_ && foresight_.run == shown_->run ? &foresight_ : nullptr;
}

void PlotPanel::remove(const ValueKey& key) {
    std::erase(keys_, key);
    rebuild();
    emit changed();
}

void PlotPanel::removeReal() {
    if (std::erase_if(keys_, readsReality) == 0) return;
    rebuild();
    emit changed();
}

void PlotPanel::clear() {
    keys_.clear();
    rebuild();
    emit changed();
}

std::map<ValueKey, QColor> PlotPanel::plotted() const {
    std::map<ValueKey, QColor> plotted;
    for (std::size_t i = 0; i < keys_.size(); ++i) plotted.emplace(keys_[i], looks_[i].colour);
    return plotted;
}

std::optional<std::uint32_t> PlotPanel::ghostBranch() const {
    if (shown_->besideBranch) return shown_->besideBranch;
    const std::uint32_t parent = shown_->branches[shown_->branch].parent;
    return parent == shown_->branch ? std::nullopt : std::optional(parent);
}

void PlotPanel::setShown(std::shared_ptr<const Shown> shown) {
    const auto lineages = [this] { return std::pair(shown_->branch, ghostBranch()); };
    const bool same = shown_ && shown_->run == shown->run && shown_->branches.size() == shown->branches.size();
    const auto before = same ? std::optional(lineages()) : std::nullopt;
    const bool sameRun = shown_ && shown_->run == shown->run;
    const bool sameReality = shown_ && shown_->frame->reality == shown->frame->reality;
    shown_ = std::move(shown);
    if (!sameRun) {
        // It may have other bodies.
        const auto unknown = [this](const ValueKey& key) { return !plottedValue(*shown_->frame->scenario, key); };
        if (std::erase_if(keys_, unknown) > 0) emit changed();
        view_->showAll();
    }
    if (!before || *before != lineages() || !sameReality)
        rebuild();
    else
        follow();
    updateNumbers();
}

/// Says which ticks are wanted, the shown branch's first, and how far time has come.
void PlotPanel::follow() {
    std::vector<BranchTicks> wanted;
    std::int64_t first = shown_->first, last = shown_->last;
    const auto want = [&](const BranchTicks& part, bool ghost) {
        const BranchInfo& info = shown_->branches[part.branch];
        const std::int64_t end = std::min(part.last, info.last);
        const auto known = std::find_if(wanted.begin(), wanted.end(),
                                        [&](const BranchTicks& one) { return one.branch == part.branch; });
        if (known == wanted.end())
            wanted.push_back({part.branch, info.first, end});
        else
            known->last = std::max(known->last, end);
        first = std::min(first, std::max(part.first, info.first));
        if (ghost) last = std::max(last, end);
    };
    const std::vector<BranchTicks>& lineage = shown_->branches[shown_->branch].lineage;
    for (auto part = lineage.rbegin(); part != lineage.rend(); ++part) want(*part, false);
    if (const auto ghost = ghostBranch())
        for (const BranchTicks& part : shown_->branches[*ghost].lineage) want(part, true);
    std::erase_if(wanted, [](const BranchTicks& one) { return one.last < one.first; });
    series_->follow(shown_->run, shown_->frame->reality,
                    keys_.empty() ? std::vector<BranchTicks>{} : std::move(wanted));
    view_->setTime({first, last, shown_->tick(), shown_->frame->scene().tickLength,
                    foresight() != nullptr ? foresight()->end : 0});
    updateProgress();
}

QString PlotPanel::ghostName() const {
    if (!shown_ || keys_.empty()) return {};
    const auto ghost = ghostBranch();
    return !ghost ? QString() : *ghost == 0 ? tr("the run") : qtText(shown_->branches[*ghost].name);
}

std::vector<PlotCurve> PlotPanel::curvesIn(const Theme& theme, ModelNames names) const {
    if (!shown_ || keys_.empty()) return {};
    const std::vector<PlottedValue> plotted = valuesOf(shown_, keys_);
    const std::vector<CurveLook> looks = looksOf(keys_, plotted, realityOf(shown_), theme);
    const Foresight* const known = foresight();
    const std::vector<CurveWords> words =
        wordsOf(keys_, plotted, realityOf(shown_), known != nullptr ? known->model : QString(), names);
    std::vector<PlotCurve> curves;
    const auto addCurves = [&](std::uint32_t branch, bool ghost) {
        const std::vector<BranchTicks>& lineage = shown_->branches[branch].lineage;
        for (std::size_t i = 0; i < plotted.size(); ++i) {
            PlotCurve curve = curveOf(series_->series(), keys_[i], plotted[i], lineage);
            curve.colour = looks[i].colour;
            curve.style = looks[i].style;
            curve.label = words[i].label;
            curve.quantity = words[i].quantity;
            curve.fromZero = isError(keys_[i]);
            curve.ghost = ghost;
            if (ghost) curve.id += "\nghost";
            if (known != nullptr && !ghost)
                if (const auto ahead = known->ahead.find(keys_[i]); ahead != known->ahead.end())
                    curve.ahead = ahead->second;
            if (known != nullptr && !ghost)
                if (const auto expected = known->expected.find(keys_[i]); expected != known->expected.end())
                    curve.expected = expected->second;
            curves.push_back(std::move(curve));
        }
    };
    if (const auto ghost = ghostBranch()) addCurves(*ghost, true);
    addCurves(shown_->branch, false);
    return curves;
}

void PlotPanel::rebuild() {
    hint_->setVisible(keys_.empty());
    area_->setVisible(!keys_.empty());
    looks_ = looksOf(keys_, valuesOf(shown_, keys_), realityOf(shown_), theme_);
    series_->want(keys_);
    view_->setCurves(curvesIn(theme_, ModelNames::brief), ghostName());
    ghostNote_->setText(tr("thin: %1").arg(ghostName()));
    ghostNote_->setVisible(!ghostName().isEmpty());
    updateList();
    if (shown_) follow();
}

/// Axis after axis, what its curves are held against last. Several axes of one body are named.
void PlotPanel::updateList() {
    const std::vector<PlottedValue> plotted = valuesOf(shown_, keys_);
    const std::vector<CurveWords> words = wordsOf(
        keys_, plotted, realityOf(shown_), foresight() != nullptr ? foresight()->model : QString(), ModelNames::brief);
    std::map<QString, std::pair<std::size_t, QString>> axes;  // by unit: its place and its name
    for (std::size_t i = 0; i < plotted.size(); ++i)
        axes.emplace(qtText(plotted[i].unit), std::pair(axes.size(), words[i].axis));
    const bool byBody = std::any_of(words.begin(), words.end(), [](const auto& one) { return !one.group.isEmpty(); });
    const bool byAxis = !byBody && axes.size() > 1;
    std::vector<CurveList::Line> lines;
    const auto add = [&](const QPen& pen, const QString& label, const QString& unit, const QString& tip,
                         const QString& body) {
        const QString axis = unit.isEmpty() ? axes[unit].second : axes[unit].second + " (" + unit + ')';
        lines.push_back({pen, label, byAxis ? QString() : unit, tip, byAxis ? axis : body,
                         static_cast<int>(lines.size()), axes[unit].first});
    };
    for (std::size_t i = 0; i < plotted.size(); ++i) {
        PlotCurve curve;
        curve.colour = looks_[i].colour;
        curve.style = looks_[i].style;
        add(curvePen(curve), words[i].inGroup, qtText(plotted[i].unit), qtText(plotted[i].name).simplified(),
            words[i].group);
    }
    const QPen dashed(markColour(TimelineMark::Kind::divergence, theme_), 1, Qt::DashLine);
    for (const PlotLevel& level : levels())
        add(dashed, tr("bound"), level.unit,
            tr("Farther off for 0.3 s it has left the trajectory of the log; the upright line is where"), {});
    for (const PlotCurve* const curve : shadedOf(view_->curves(), byAxis)) {
        add(expectedPen(*curve, groundOf(theme_)), tr("50 %, fainter: 90 %"), curve->unit,
            tr("Shaded: where half and 90 % of all runs are, by the noise of the robot's motion"), {});
        lines.back().unit.clear();
        lines.back().counts = false;
    }
    if (!byBody)
        std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.axis < b.axis; });
    list_->setLines(lines, theme_);
    updateNumbers();
}

std::vector<PlotLevel> PlotPanel::levels() const {
    std::vector<PlotLevel> levels;
    const std::vector<PlottedValue> plotted = valuesOf(shown_, keys_);
    for (const PlotLevel& level : view_->levels())
        if (std::any_of(plotted.begin(), plotted.end(),
                        [&](const auto& value) { return qtText(value.unit) == level.unit; }))
            levels.push_back(level);
    return levels;
}

void PlotPanel::setReferences(std::vector<PlotLevel> levels, std::optional<std::int64_t> instant) {
    if (levels == view_->levels() && instant == view_->instant()) return;
    view_->setReferences(std::move(levels), instant);
    updateList();
}

/// At the mouse, or now.
void PlotPanel::updateNumbers() {
    if (!shown_ || !isVisible()) return;
    const std::int64_t tick = hovered_.value_or(shown_->tick());
    const int count = static_cast<int>(keys_.size());
    for (const PlotCurve& curve : view_->curves())
        if (const auto row = static_cast<int>(&curve - view_->curves().data()) % std::max(count, 1); !curve.ghost)
            list_->setNumber(row, curve.at(tick), curve.decimals);
    int row = count;
    for (const PlotLevel& level : levels())
        list_->setNumber(row++, levelAt(level, static_cast<double>(tick)), levelDecimals);
}

void PlotPanel::updateProgress() {
    const std::int64_t behind = series_->series().behind();
    if (behind == 0) mostBehind_ = 0;
    mostBehind_ = std::max(mostBehind_, behind);
    progress_->setVisible(mostBehind_ > worthABar);
    if (mostBehind_ <= worthABar) return;
    bar_->setRange(0, 1000);
    bar_->setValue(static_cast<int>(1000 * (mostBehind_ - behind) / mostBehind_));
}

/// Most of the width is the plot's.
void PlotPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    side_->setFixedWidth(std::clamp(static_cast<int>(mostSideShare * width()), leastSideWidth, mostSideWidth));
}

}  // namespace mrose::gui
