#include "frame/docks.h"

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QLayout>
#include <QPainter>
#include <QScrollArea>
#include <QSettings>
#include <QStyle>
#include <QTabBar>
#include <QTabWidget>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "frame/shrinking_area.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

constexpr std::array layoutNames{"run", "log"};

QString stateKey(std::size_t layout) { return QString("window/docks_%1").arg(layoutNames[layout]); }

QString sizeKey(std::size_t layout, const QDockWidget& dock) {
    return QString("window/size_%1/%2").arg(layoutNames[layout], dock.objectName());
}

/// The name of a folded panel, from above to below.
class FoldedTitle final : public QWidget {
public:
    explicit FoldedTitle(QDockWidget& dock) : QWidget(&dock) {}
    QSize sizeHint() const override {
        return {fontMetrics().height() + 6, fontMetrics().horizontalAdvance(parentWidget()->windowTitle()) + 16};
    }
    QSize minimumSizeHint() const override { return {sizeHint().width(), 0}; }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        QPainter painter(this);
        painter.rotate(90);
        painter.drawText(QRect(8, -width(), height(), width()), Qt::AlignLeft | Qt::AlignVCenter,
                         parentWidget()->windowTitle());
    }
};

struct Extent {
    int wanted = 0, least = 0;  ///< pixels
};

/// What there is not enough room for is taken from all, from each in proportion to what it can give.
QList<int> fitted(const std::vector<Extent>& extents, int room) {
    int tooMuch = -room, slack = 0;
    for (const Extent& extent : extents) {
        tooMuch += std::max(extent.wanted, extent.least);
        slack += std::max(0, extent.wanted - extent.least);
    }
    const double share = tooMuch <= 0 || slack == 0 ? 0 : std::min(1.0, static_cast<double>(tooMuch) / slack);
    QList<int> sizes;
    for (const Extent& extent : extents) {
        const int gives = static_cast<int>(std::ceil(share * std::max(0, extent.wanted - extent.least)));
        sizes << std::max(extent.wanted, extent.least) - gives;
    }
    return sizes;
}

/// A panel that is behind another comes to the front when it is asked for, instead of going away.
void raiseInsteadOfHiding(QDockWidget& dock) {
    const auto behind = std::make_shared<bool>(false);
    // Before the panel hears of it.
    QObject::connect(dock.toggleViewAction(), &QAction::toggled, &dock,
                     [&dock, behind](bool on) { *behind = !on && dock.visibleRegion().isEmpty(); });
    QObject::connect(dock.toggleViewAction(), &QAction::triggered, &dock, [&dock, behind](bool on) {
        const bool wasBehind = *behind;
        if (wasBehind) dock.show();
        if (on || wasBehind) dock.raise();
    });
}

/// Without scrolling, its words in as many lines as they take now.
int leastHeight(const QWidget& content) {
    const QLayout* const layout = content.layout();
    const bool wraps = layout != nullptr && layout->hasHeightForWidth();
    return std::max(content.minimumSizeHint().height(), wraps ? layout->heightForWidth(content.width()) : 0);
}

bool isBeside(Qt::DockWidgetArea area) { return area == Qt::LeftDockWidgetArea || area == Qt::RightDockWidgetArea; }

}  // namespace

Docks::Docks(QMainWindow& window, FieldView& field) : QObject(&window), window_(window), field_(field) {
    window.installEventFilter(this);
    window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    window.setTabPosition(Qt::LeftDockWidgetArea, QTabWidget::West);
    soon_.setSingleShot(true);
    connect(&soon_, &QTimer::timeout, this, &Docks::fold);
    afterClick_.setSingleShot(true);
    afterClick_.setInterval(QApplication::doubleClickInterval());
    connect(&afterClick_, &QTimer::timeout, this, [this] {
        if (field_.held())
            afterClick_.start();
        else
            fold();
    });
}

QDockWidget& Docks::add(const char* name, const QString& title, QWidget* content, Qt::DockWidgetArea area,
                        const QSize& size, std::optional<int> leastHeight) {
    auto* made = new QDockWidget(title, &window_);
    made->setObjectName(name);
    made->setWidget(new ShrinkingArea(content));
    window_.addDockWidget(area, made);
    panels_.push_back({made, size, leastHeight});
    made->installEventFilter(this);
    raiseInsteadOfHiding(*made);
    return *made;
}

void Docks::keepAsNew() { new_ = present(); }

QDockWidget& Docks::operator[](const char* name) const { return *window_.findChild<QDockWidget*>(name); }

Docks::Panel& Docks::panelOf(const QObject* dock) {
    return *std::find_if(panels_.begin(), panels_.end(), [&](const Panel& panel) { return panel.dock == dock; });
}

bool Docks::isFolded(const QWidget& part) {
    const auto* const dock = qobject_cast<const QDockWidget*>(&part);
    return dock != nullptr && dock->features().testFlag(QDockWidget::DockWidgetVerticalTitleBar);
}

bool Docks::Panel::folded() const { return isFolded(*dock); }

void Docks::setEmpty(const char* name, bool empty) {
    if (std::exchange(panelOf(&(*this)[name]).empty, empty) == empty) return;
    if (field_.held())
        afterClick_.start();
    else if (!afterClick_.isActive())
        fold();
}

/// One that has its side of the window for itself.
bool Docks::mayFold(const QDockWidget& dock) const {
    const Qt::DockWidgetArea area = window_.dockWidgetArea(const_cast<QDockWidget*>(&dock));
    return isBeside(area) && !dock.isFloating() && shownIn(area).size() <= 1;
}

void Docks::fold() {
    for (const Panel& panel : panels_) {
        const bool folded = panel.empty && mayFold(*panel.dock);
        if (panel.folded() == folded) continue;
        panel.dock->setFeatures(panel.dock->features().setFlag(QDockWidget::DockWidgetVerticalTitleBar, folded));
        panel.dock->widget()->setMaximumWidth(folded ? 0 : QWIDGETSIZE_MAX);
        delete panel.dock->titleBarWidget();
        panel.dock->setTitleBarWidget(folded ? new FoldedTitle(*panel.dock) : nullptr);
    }
    arrange();
}

void Docks::setLayout(Layout layout) {
    if (layout == layout_) return;
    kept_[static_cast<std::size_t>(layout_)] = present();
    layout_ = layout;
    open(kept_[static_cast<std::size_t>(layout)]);
}

void Docks::reset() {
    kept_ = {};
    openNew();
}

Docks::Kept Docks::present() const {
    Kept kept{window_.saveState(version), {}};
    for (const Panel& panel : panels_) kept.sizes.push_back(panel.size);
    return kept;
}

void Docks::setSizes(const std::vector<QSize>& sizes) {
    for (std::size_t i = 0; i < panels_.size(); ++i) panels_[i].size = sizes[i];
}

void Docks::open(const Kept& kept) {
    if (kept.state.isEmpty()) return openNew();
    window_.restoreState(kept.state, version);
    setSizes(kept.sizes);
    fold();
}

/// Of a log, its own panel lies in front of those of the run.
void Docks::openNew() {
    window_.restoreState(new_.state, version);
    setSizes(new_.sizes);
    if (layout_ == Layout::log) {
        QDockWidget& first = (*this)["reality"];
        first.show();
        for (const Panel* panel : shownIn(window_.dockWidgetArea(&first)))
            if (panel->dock != &first) window_.tabifyDockWidget(&first, panel->dock);
        first.raise();
    }
    fold();
}

void Docks::save(QSettings& settings) {
    std::array<Kept, 2> all = kept_;
    all[static_cast<std::size_t>(layout_)] = present();
    for (std::size_t layout = 0; layout < all.size(); ++layout) {
        settings.setValue(stateKey(layout), all[layout].state);
        for (std::size_t i = 0; i < all[layout].sizes.size(); ++i)
            settings.setValue(sizeKey(layout, *panels_[i].dock), all[layout].sizes[i]);
    }
}

void Docks::restore(const QSettings& settings) {
    for (std::size_t layout = 0; layout < kept_.size(); ++layout) {
        Kept& kept = kept_[layout] = {settings.value(stateKey(layout)).toByteArray(), new_.sizes};
        for (std::size_t i = 0; i < panels_.size(); ++i)
            kept.sizes[i] = settings.value(sizeKey(layout, *panels_[i].dock), kept.sizes[i]).toSize();
    }
    open(kept_[static_cast<std::size_t>(layout_)]);
}

/// The layout has done its work before a filter sees that the window has another size.
bool Docks::eventFilter(QObject* watched, QEvent* event) {
    const QEvent::Type type = event->type();
    if (watched == &window_) {
        // The window itself is pressed where a separator is.
        if (type == QEvent::MouseButtonPress) dragged_ = true;
        if (type == QEvent::MouseButtonRelease) dragged_ = false;
        if (type == QEvent::Resize || type == QEvent::Show) arrange();
        return false;
    }
    if (type == QEvent::Resize && dragged_)
        if (Panel& panel = panelOf(watched); !panel.folded()) panel.size = panel.dock->size();
    if (type == QEvent::Show || type == QEvent::Hide) soon_.start(0);
    return false;
}

std::vector<const Docks::Panel*> Docks::shownIn(Qt::DockWidgetArea area) const {
    std::vector<const Panel*> panels;
    for (const Panel& panel : panels_)
        if (!panel.dock->isHidden() && !panel.dock->isFloating() && window_.dockWidgetArea(panel.dock) == area)
            panels.push_back(&panel);
    return panels;
}

void Docks::arrange() {
    if (!window_.isVisible()) return;
    arrangeColumns();
    window_.layout()->activate();
    for (const Qt::DockWidgetArea area : {Qt::LeftDockWidgetArea, Qt::RightDockWidgetArea}) arrangeColumn(area);
    arrangeRows();
}

/// What the field needs is taken from both sides: first what is more than is in them, and then they scroll.
void Docks::arrangeColumns() {
    const std::array columns{shownIn(Qt::LeftDockWidgetArea), shownIn(Qt::RightDockWidgetArea)};
    int room = window_.width() - static_cast<int>(std::ceil(leastFieldWidth * window_.width()));
    std::vector<Extent> toContents, toLeast;
    for (const auto& column : columns) {
        Extent &content = toContents.emplace_back(), &least = toLeast.emplace_back();
        for (const Panel* panel : column) {
            const auto* area = static_cast<const ShrinkingArea*>(panel->dock->widget());
            least.least = std::max(least.least, panel->dock->minimumSizeHint().width());
            if (panel->folded()) continue;
            content.least = std::max(content.least, area->contentWidth());
            content.wanted = std::max(content.wanted, panel->size.width());
        }
        content.least = std::max(content.least, least.least);
        if (!column.empty()) room -= separator();
    }
    int tabs = 0;  // of the left column, which takes them as its own
    for (const QTabBar* bar : window_.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly))
        if (bar->isVisible() && bar->shape() == QTabBar::RoundedWest) tabs += bar->width();
    room -= tabs;
    const QList<int> unscrolled = fitted(toContents, room);
    for (std::size_t i = 0; i < columns.size(); ++i) toLeast[i].wanted = unscrolled[static_cast<int>(i)];
    QList<int> widths = fitted(toLeast, room);
    widths.front() += tabs;
    for (std::size_t i = 0; i < columns.size(); ++i)
        for (const Panel* panel : columns[i])
            window_.resizeDocks({panel->dock}, {widths[static_cast<int>(i)]}, Qt::Horizontal);
}

/// One above another, each as high as wanted, and where there is no room for that, at least as what is in it; so is one
/// that has nothing to show, and the others have its room.
void Docks::arrangeColumn(Qt::DockWidgetArea area) {
    std::vector<Extent> extents;
    QList<QDockWidget*> docks;
    int room = 0, spare = 0, full = 0;
    for (const Panel* panel : shownIn(area)) {
        if (!window_.tabifiedDockWidgets(panel->dock).isEmpty()) return;
        const auto* content = static_cast<const QScrollArea*>(panel->dock->widget());
        const int title = panel->dock->height() - content->height();
        const int contents = title + leastHeight(*content->widget());
        const int least = panel->empty ? contents : panel->leastHeight.value_or(contents);
        extents.push_back({panel->empty ? least : panel->size.height(), least});
        docks << panel->dock;
        if (!panel->empty) ++full;
        spare -= extents.back().wanted;
        room += panel->dock->height();
    }
    spare += room;
    std::size_t i = 0;
    for (const Panel* panel : shownIn(area)) {
        Extent& extent = extents[i++];
        if (spare <= 0 || panel->empty) continue;
        const int more = spare / full--;
        extent.wanted += more;
        spare -= more;
    }
    if (docks.size() > 1) window_.resizeDocks(docks, fitted(extents, room), Qt::Vertical);
}

/// Those above and below it leave the field its height.
void Docks::arrangeRows() {
    const QWidget* middle = window_.centralWidget();
    int room = middle->height() - static_cast<int>(std::ceil(leastFieldHeight * window_.height()));
    for (const QObject* child : middle->children())
        if (const auto* part = qobject_cast<const QWidget*>(child);
            part != nullptr && !part->isHidden() && !part->isAncestorOf(&field_))
            room -= part->sizeHint().height();
    for (const Qt::DockWidgetArea area : {Qt::TopDockWidgetArea, Qt::BottomDockWidgetArea})
        for (const Panel* panel : shownIn(area))
            window_.resizeDocks({panel->dock}, {std::min(panel->size.height(), panel->dock->height() + room)},
                                Qt::Vertical);
}

int Docks::separator() const {
    return window_.style()->pixelMetric(QStyle::PM_DockWidgetSeparatorExtent, nullptr, &window_);
}

}  // namespace mrose::gui
