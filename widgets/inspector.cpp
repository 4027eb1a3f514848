#include "widgets/inspector.h"

#include <QFontDatabase>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "widgets/inspector_rows.h"

namespace mrose {

Inspector::Inspector(QWidget* parent)
    : QWidget(parent),
      chip_(new QLabel),
      title_(new QLabel),
      hint_(new QLabel(tr("Click a robot or the ball to see all about it."))),
      queue_(new CommandQueue),
      tree_(new QTreeWidget) {
    auto* head = new QHBoxLayout;
    chip_->setFixedSize(14, 14);
    QFont bold = font();
    bold.setBold(true);
    title_->setFont(bold);
    title_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    head->addWidget(chip_);
    head->addWidget(title_, 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 8, 8, 4);
    layout->setSpacing(6);
    layout->addLayout(head);
    hint_->setWordWrap(true);
    layout->addWidget(hint_);
    layout->addWidget(queue_);
    tree_->setColumnCount(2);
    tree_->setHeaderHidden(true);
    tree_->setRootIsDecorated(true);
    tree_->setIndentation(12);
    tree_->setUniformRowHeights(true);
    tree_->setFrameShape(QFrame::NoFrame);
    tree_->setAccessibleName(tr("Values of the selected body"));
    tree_->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
    tree_->header()->setStretchLastSection(true);
    layout->addWidget(tree_, 1);
    refresh();
}

void Inspector::setFrame(std::shared_ptr<const FieldFrame> frame) {
    frame_ = std::move(frame);
    if (isVisible()) refresh();
}

void Inspector::setBody(std::optional<std::size_t> body) {
    body_ = body;
    refresh();
}

void Inspector::setTheme(const Theme& theme) {
    theme_ = theme;
    queue_->setTheme(theme);
    refresh();
}

void Inspector::refresh() {
    const bool some = frame_ && body_ && *body_ < frame_->scene().bodyCount();
    const bool robot = some && *body_ < frame_->state.robots.size();
    hint_->setVisible(!some);
    chip_->setVisible(robot);
    title_->setVisible(some);
    tree_->setVisible(some);
    queue_->setVisible(robot);
    if (!some) return;
    const Scene& scene = frame_->scene();
    const QString type = QString::fromStdString(robot ? scene.typeOf(*body_).name
                                                      : scene.typeOfObject(*body_ - scene.robots.size()).name);
    const QString name = QString::fromStdString(frame_->nameOf(*body_));
    title_->setText(type.compare(name, Qt::CaseInsensitive) == 0 ? name : name + "  \u00b7  " + type);
    if (robot) {
        chip_->setStyleSheet(QString("background:%1;border:1px solid %2;border-radius:7px")
                                 .arg(robotColour(*body_).name(), theme_.line.name()));
        const CommandView view = frame_->scenario->commandsOf(frame_->state, *body_);
        CommandQueue::Content content{{}, view.beforeFirst(), scene.timeOf(frame_->state.tick),
                                      scene.modelOf(*body_).deadTimes()};
        for (std::size_t i = 0; i < view.size(); ++i) content.commands.push_back({view.issueTime(i), view.command(i)});
        queue_->setContent(std::move(content));
    }
    // Rows are written over, not made anew, so that nothing jumps or closes while playing.
    const std::vector<InspectorSection> sections = inspectorSections(*frame_, *body_);
    while (tree_->topLevelItemCount() > static_cast<int>(sections.size())) delete tree_->takeTopLevelItem(tree_->topLevelItemCount() - 1);
    for (int s = 0; s < static_cast<int>(sections.size()); ++s) {
        const InspectorSection& section = sections[static_cast<std::size_t>(s)];
        QTreeWidgetItem* top = tree_->topLevelItem(s);
        if (top == nullptr) {
            top = new QTreeWidgetItem(tree_);
            top->setFirstColumnSpanned(true);
            top->setExpanded(true);
            QFont bold = font();
            bold.setBold(true);
            top->setFont(0, bold);
        }
        top->setText(0, section.title);
        while (top->childCount() > static_cast<int>(section.rows.size())) delete top->takeChild(top->childCount() - 1);
        for (int r = 0; r < static_cast<int>(section.rows.size()); ++r) {
            const InspectorSection::Row& row = section.rows[static_cast<std::size_t>(r)];
            QTreeWidgetItem* item = top->child(r);
            if (item == nullptr) item = new QTreeWidgetItem(top);
            item->setText(0, row.name);
            item->setText(1, row.value);
            item->setToolTip(0, row.tip);
            item->setToolTip(1, row.value);
            item->setForeground(0, theme_.quietText);
            item->setForeground(1, row.notable ? theme_.contact : theme_.text);
        }
    }
}

}  // namespace mrose
