#include "widgets/inspector.h"

#include <QApplication>
#include <QClipboard>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <functional>
#include <utility>

#include "widgets/eliding_label.h"
#include "widgets/inspector_delegate.h"
#include "widgets/qt_text.h"
#include "widgets/whole_rows.h"

namespace mrose {
namespace {

using Delegate = InspectorDelegate;
constexpr double largestFont = 9.5;  // points

QFont smallFont(QFont font) {
    font.setPointSizeF(std::min(largestFont, font.pointSizeF()));
    return font;
}

}  // namespace

Inspector::Inspector(QWidget* parent)
    : QWidget(parent),
      chip_(new QLabel),
      title_(new ElidingLabel),
      kind_(new ElidingLabel),
      hint_(new QLabel(tr("Click a robot or the ball to see all about it."))),
      queue_(new CommandQueue),
      tree_(new WholeRows<QTreeWidget>) {
    setFont(smallFont(font()));
    auto* head = new QHBoxLayout;
    chip_->setFixedSize(14, 14);
    QFont bold = smallFont(font());
    bold.setPointSizeF(bold.pointSizeF() + 1);
    bold.setBold(true);
    title_->setFont(bold);
    title_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    head->addWidget(chip_);
    head->addWidget(title_, 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 8, 4, 4);
    layout->setSpacing(6);
    layout->addLayout(head);
    layout->addWidget(kind_);
    hint_->setWordWrap(true);
    layout->addWidget(hint_);
    layout->addWidget(queue_);
    tree_->setColumnCount(3);
    tree_->setHeaderHidden(true);
    tree_->setIndentation(7);
    tree_->setFrameShape(QFrame::NoFrame);
    tree_->setFont(smallFont(font()));
    tree_->setExpandsOnDoubleClick(false);
    tree_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    tree_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    tree_->setContextMenuPolicy(Qt::CustomContextMenu);
    tree_->setAccessibleName(tr("Values of the selected body"));
    tree_->setItemDelegate(new Delegate(tree_));
    tree_->header()->setStretchLastSection(false);
    tree_->header()->setMinimumSectionSize(20);
    tree_->header()->setSectionResizeMode(Delegate::nameColumn, QHeaderView::Interactive);
    tree_->header()->setSectionResizeMode(Delegate::valueColumn, QHeaderView::Stretch);
    tree_->header()->setSectionResizeMode(Delegate::plotColumn, QHeaderView::Fixed);
    tree_->header()->resizeSection(Delegate::plotColumn, Delegate::markWidth);
    tree_->installEventFilter(this);
    tree_->viewport()->installEventFilter(this);
    layout->addWidget(tree_, 1);
    const auto pathOf = [](const QTreeWidgetItem* item) { return item->data(0, Delegate::pathRole).toString(); };
    connect(tree_->header(), &QHeaderView::sectionResized, this, [this](int column, int, int size) {
        if (column == Delegate::nameColumn && !fitting_) nameWidth_ = size;
    });
    connect(tree_, &QTreeWidget::itemExpanded, this, [this, pathOf](QTreeWidgetItem* item) {
        open_.insert(pathOf(item));
        if (!syncing_) refresh();
    });
    connect(tree_, &QTreeWidget::itemCollapsed, this,
            [this, pathOf](QTreeWidgetItem* item) { open_.remove(pathOf(item)); });
    connect(tree_, &QTreeWidget::itemClicked, this, [this](QTreeWidgetItem* item, int column) {
        if (column != Delegate::nameColumn) askForPlot(item);
    });
    connect(tree_, &QTreeWidget::itemDoubleClicked, this, [this](QTreeWidgetItem* item, int column) {
        if (column == Delegate::nameColumn) askForPlot(item);
    });
    connect(tree_, &QTreeWidget::customContextMenuRequested, this, &Inspector::showMenu);
    connect(queue_, &CommandQueue::commandActivated, this, &Inspector::commandActivated);
    refresh();
}

void Inspector::setFrame(std::shared_ptr<const FieldFrame> frame) {
    frame_ = std::move(frame);
    if (isVisible()) refresh();
}

void Inspector::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    refresh();
}

void Inspector::setBody(std::optional<std::size_t> body) {
    body_ = body;
    widestName_ = 0;
    refresh();
}

void Inspector::setTheme(const Theme& theme) {
    theme_ = theme;
    queue_->setTheme(theme);
    static_cast<Delegate*>(tree_->itemDelegate())->setTheme(theme);
    refresh();
}

void Inspector::setPlotted(std::map<ValueKey, QColor> plotted) {
    plotted_ = std::move(plotted);
    refresh();
}

std::optional<ValueKey> Inspector::valueOf(const QTreeWidgetItem* item) const {
    if (item == nullptr || !item->data(0, Delegate::plottableRole).toBool()) return {};
    const QStringList parts = item->data(0, Delegate::keyRole).toStringList();
    return ValueKey{parts[0].toStdString(), parts[1].toStdString(), parts[2].toStdString(), parts[3].toStdString()};
}

std::optional<ValueKey> Inspector::currentValue() const { return valueOf(tree_->currentItem()); }

void Inspector::askForPlot(const QTreeWidgetItem* item) {
    if (const auto key = valueOf(item)) emit plotRequested(*key);
}

void Inspector::showMenu(const QPoint& place) {
    QTreeWidgetItem* item = tree_->itemAt(place);
    if (item == nullptr) return;
    QMenu menu(this);
    if (const auto key = valueOf(item)) {
        menu.addAction(plotted_.count(*key) != 0 ? tr("&Remove from the plot") : tr("&Plot"), this,
                       [this, key] { emit plotRequested(*key); });
        menu.addAction(tr("Plot of &all robots"), this, [this, key] { emit plotOfAllRequested(*key); });
        menu.addSeparator();
    }
    const QString text =
        (item->text(Delegate::valueColumn) + ' ' + item->data(Delegate::valueColumn, Delegate::unitRole).toString())
            .trimmed();
    menu.addAction(tr("&Copy"), this, [text] { QApplication::clipboard()->setText(text); });
    menu.exec(tree_->viewport()->mapToGlobal(place));
}

/// Where there is little room, names give way: numbers are never cut.
void Inspector::fitColumns() {
    const int numbers = tree_->fontMetrics().horizontalAdvance("-00.000 rad/s") + 10;
    const int room = tree_->viewport()->width() - Delegate::markWidth - numbers;
    fitting_ = true;
    tree_->header()->resizeSection(Delegate::nameColumn,
                                   std::clamp(room, 40, std::max(40, nameWidth_.value_or(widestName_))));
    fitting_ = false;
    tree_->doItemsLayout();  // texts may need another line now, or one less
}

/// It does not become narrower as rows come and go.
void Inspector::measureNames() {
    int widest = widestName_;
    const std::function<void(const QModelIndex&)> measure = [&](const QModelIndex& above) {
        for (int row = 0; row < tree_->model()->rowCount(above); ++row) {
            const QModelIndex index = tree_->model()->index(row, Delegate::nameColumn, above);
            if (!tree_->isFirstColumnSpanned(row, above)) widest = std::max(widest, Delegate::nameWidth(*tree_, index));
            if (tree_->isExpanded(index)) measure(index);
        }
    };
    measure({});
    if (widest == widestName_) return;
    widestName_ = widest;
    fitColumns();
}

bool Inspector::eventFilter(QObject* watched, QEvent* event) {
    if (watched == tree_->viewport() && event->type() == QEvent::Resize) fitColumns();
    if (watched != tree_ || tree_->currentItem() == nullptr) return QWidget::eventFilter(watched, event);
    QTreeWidgetItem* item = tree_->currentItem();
    const auto key = event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride
                         ? static_cast<QKeyEvent*>(event)->key()
                         : 0;
    const bool fold = (key == Qt::Key_Left || key == Qt::Key_Right) && item->childCount() > 0;
    const bool enter = key == Qt::Key_Return || key == Qt::Key_Enter;
    if (event->type() == QEvent::ShortcutOverride && (fold || enter)) {
        // The arrows fold what can be folded; on any other row they step.
        event->accept();
        return true;
    }
    if (event->type() == QEvent::KeyPress && fold) {
        item->setExpanded(key == Qt::Key_Right);
        return true;
    }
    if (event->type() == QEvent::KeyPress && enter) {
        if (valueOf(item))
            askForPlot(item);
        else
            item->setExpanded(!item->isExpanded());
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

void Inspector::refreshHead(bool robot) {
    const Scene& scene = frame_->scene();
    const QString type =
        qtText(robot ? scene.typeOf(*body_).name : scene.typeOfObject(*body_ - scene.robots.size()).name);
    name_ = qtText(frame_->nameOf(*body_));
    type_ = type.compare(name_, Qt::CaseInsensitive) == 0 ? QString() : type;
    fitTitle();
    if (!robot) return;
    chip_->setStyleSheet(QString("background:%1;border:1px solid %2;border-radius:7px")
                             .arg(robotColour(frame_->scene(), *body_).name(), theme_.line.name()));
    queue_->setContent(
        {deadTimeQueueOf(*frame_->scenario, frame_->state, *body_), robotColour(frame_->scene(), *body_)});
}

/// A type that has no room beside the name stands below it.
void Inspector::fitTitle() {
    const QString both = type_.isEmpty() ? name_ : name_ + "  \u00b7  " + type_;
    const bool fits = title_->fontMetrics().horizontalAdvance(both) <= title_->width();
    title_->setText(fits ? both : name_);
    kind_->setText(type_);
    kind_->setVisible(title_->isVisibleTo(this) && !fits && !type_.isEmpty());
}

void Inspector::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fitTitle();
}

void Inspector::refresh() {
    const bool some = frame_ && body_ && *body_ < frame_->scene().bodyCount();
    const bool robot = some && *body_ < frame_->state.robots.size();
    hint_->setVisible(!some);
    chip_->setVisible(robot);
    title_->setVisible(some);
    if (!some) kind_->hide();
    tree_->setVisible(some);
    queue_->setVisible(robot);
    if (!some) return;
    refreshHead(robot);
    syncing_ = true;
    const auto isOpen = [this](const QString& path) { return open_.contains(path); };
    sync(tree_->invisibleRootItem(), {}, inspectorRows(*frame_, *body_, isOpen));
    syncing_ = false;
    measureNames();
}

/// Makes items the rows' images: those that are there keep their places and states, whatever comes and goes.
void Inspector::sync(QTreeWidgetItem* parent, const QString& path, const std::vector<InspectorRow>& rows) {
    for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
        const InspectorRow& row = rows[static_cast<std::size_t>(i)];
        const QString own = path.isEmpty() ? row.id : path + '/' + row.id;
        int found = i;
        while (found < parent->childCount() && parent->child(found)->data(0, Delegate::pathRole) != own) ++found;
        QTreeWidgetItem* item = nullptr;
        if (found < parent->childCount()) {
            // Those between are of no row any more, or come later again.
            for (; found > i; --found) delete parent->takeChild(i);
            item = parent->child(i);
        } else {
            item = new QTreeWidgetItem;
            item->setData(0, Delegate::pathRole, own);
            parent->insertChild(i, item);
            if (path.isEmpty()) {
                QFont bold = tree_->font();
                bold.setBold(true);
                item->setFont(0, bold);
                item->setData(0, Delegate::headRole, true);
            }
        }
        write(item, row);
        sync(item, own, row.children);
        if (row.open && item->data(0, Delegate::unitRole).isNull()) item->setExpanded(true);
        item->setData(0, Delegate::unitRole, true);  // from now on as the user has it
    }
    while (parent->childCount() > static_cast<int>(rows.size())) delete parent->takeChild(parent->childCount() - 1);
}

void Inspector::write(QTreeWidgetItem* item, const InspectorRow& row) {
    item->setText(Delegate::nameColumn, row.wide ? row.name.rightJustified(5) + "  " + row.value : row.name);
    if (row.wide && !item->isFirstColumnSpanned()) {
        item->setFirstColumnSpanned(true);
        QFont digits = QFontDatabase::systemFont(QFontDatabase::FixedFont);
        digits.setPointSizeF(tree_->font().pointSizeF() - 0.5);
        item->setFont(0, digits);
    }
    if (!row.cells.isEmpty()) {
        item->setFirstColumnSpanned(true);
        item->setData(Delegate::nameColumn, Delegate::cellsRole, row.cells);
    }
    item->setText(Delegate::valueColumn, row.value);
    item->setData(Delegate::valueColumn, Delegate::unitRole, row.unit);
    item->setToolTip(Delegate::nameColumn, row.wide            ? row.tip
                                           : row.tip.isEmpty() ? row.name
                                                               : row.name + ": " + row.tip);
    item->setToolTip(Delegate::valueColumn, (row.value + ' ' + row.unit).trimmed());
    const bool head = item->data(0, Delegate::headRole).toBool();
    item->setForeground(Delegate::nameColumn, row.wide && row.notable ? theme_.contact
                                              : head                  ? theme_.text
                                                                      : theme_.quietText);
    item->setForeground(Delegate::valueColumn, row.notable ? theme_.contact
                                               : row.quiet ? theme_.quietText
                                                           : theme_.text);
    item->setData(0, Delegate::plottableRole, row.plot.has_value());
    item->setData(Delegate::plotColumn, Delegate::plottableRole, row.plot.has_value());
    if (!row.plot) return;
    const auto text = [](const std::string& word) { return qtText(word); };
    item->setData(
        0, Delegate::keyRole,
        QStringList{text(row.plot->quantity), text(row.plot->body), text(row.plot->of), text(row.plot->unit)});
    const auto plotted = plotted_.find(*row.plot);
    item->setData(Delegate::plotColumn, Delegate::plottedRole,
                  plotted == plotted_.end() ? QVariant() : QVariant(plotted->second));
    item->setToolTip(Delegate::plotColumn,
                     plotted == plotted_.end() ? tr("Plot over time") : tr("Remove from the plot"));
}

}  // namespace mrose
