#include "reality/robot_dialog.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QListWidget>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <filesystem>

#include "scenario/description_file.h"
#include "widgets/field_canvas.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"
#include "widgets/warning_style.h"
#include "workflow/resources.h"

namespace mrose::gui {
namespace {

constexpr int pictureSize = 44;  // pixels

Area outlineOf(const Shape& shape) {
    Area area{{1, 1}, {-1, -1}};
    for (const ShapePart& part : shape.parts) {
        if (part.polygon.empty()) area.include(part.centre, part.radius);
        for (const Point& corner : part.polygon) area.include(corner);
    }
    return area;
}

/// Seen from above, as large beside the others as it is.
QPixmap pictureOf(const Shape& shape, double reach, double pixelRatio) {
    QPixmap picture(QSize(pictureSize, pictureSize) * pixelRatio);
    picture.setDevicePixelRatio(pixelRatio);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    ViewTransform view;
    view.setSize(QSizeF(pictureSize, pictureSize));
    view.fit({{-reach, -reach}, {reach, reach}}, QRectF(1, 1, pictureSize - 2, pictureSize - 2));
    const Theme theme = Theme::light();
    const FieldCanvas canvas{painter, view, theme};
    canvas.shape(shape, {}, true);
    canvas.heading(shape, {}, QColor(255, 255, 255));
    return picture;
}

QString choiceText(const RobotChoice& choice) {
    return QObject::tr("%1\n%2 \u00d7 %3 m, %4, dead time %5 s")
        .arg(qtText(choice.name), fixedText(choice.length, 2), fixedText(choice.width, 2), qtText(choice.motion),
             fixedText(choice.deadTime, 2));
}

}  // namespace

Expected<RobotChoice> robotChoiceOf(const std::string& file) {
    DiskDescriptions source = openDescriptions();
    const auto description = loadDescription(file, source);
    if (!description) return tl::unexpected(description.error());
    const auto* robot = std::get_if<RobotDescription>(&*description);
    if (robot == nullptr) return fail(file, "describes no robot; expected format = \"mrose robot\"");
    const Area outline = outlineOf(*robot->type.shape);
    return RobotChoice{file,
                       robot->type.name,
                       robot->type.shape,
                       outline.most.x - outline.least.x,
                       outline.most.y - outline.least.y,
                       motionKind(*robot),
                       robot->deadTime};
}

std::vector<RobotChoice> robotsThatShip() {
    std::vector<RobotChoice> choices;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(resourceFolder() / "resources" / "robots", ignored))
        if (entry.path().extension() == ".toml")
            if (auto choice = robotChoiceOf(entry.path().string())) {
                choice->file = entry.path().filename().string();
                choices.push_back(std::move(*choice));
            }
    std::sort(choices.begin(), choices.end(), [](const RobotChoice& a, const RobotChoice& b) {
        return QString::compare(qtText(a.name), qtText(b.name), Qt::CaseInsensitive) < 0;
    });
    return choices;
}

RobotDialog::RobotDialog(const QString& log, QWidget* parent)
    : QDialog(parent),
      log_(log),
      choices_(robotsThatShip()),
      robots_(new QListWidget),
      error_(new QLabel),
      open_(new QPushButton(tr("&Open the log"))) {
    setObjectName("what_drove");
    setWindowTitle(tr("What drove in this log?"));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(20, 18, 20, 16);
    layout->setSpacing(12);
    auto* about = new QLabel(tr("%1 does not say what kind of robot drove in it. Its simulation needs the robot's "
                                "outline and how it moves.")
                                 .arg(QFileInfo(log).fileName()));
    about->setWordWrap(true);
    layout->addWidget(about);
    robots_->setAccessibleName(tr("Robots"));
    robots_->setIconSize(QSize(pictureSize, pictureSize));
    robots_->setUniformItemSizes(true);
    robots_->setSpacing(1);
    layout->addWidget(robots_, 1);
    error_->setWordWrap(true);
    error_->setStyleSheet(warningStyle(*this));
    error_->hide();
    layout->addWidget(error_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    auto* file = new QPushButton(tr("&From a file\u2026"));
    file->setToolTip(tr("A robot file of one's own: resources/README.md has its keys"));
    file->setAutoDefault(false);
    buttons->addButton(open_, QDialogButtonBox::AcceptRole);
    buttons->addButton(file, QDialogButtonBox::ResetRole);
    layout->addWidget(buttons);
    open_->setDefault(true);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(file, &QPushButton::clicked, this, &RobotDialog::askForFile);
    connect(robots_, &QListWidget::itemDoubleClicked, this, &QDialog::accept);
    fill();
    robots_->setCurrentRow(0);
    robots_->setFocus();
    resize(460, 460);
}

QString RobotDialog::error() const { return error_->text(); }

void RobotDialog::fill() {
    const int current = robots_->currentRow();
    robots_->clear();
    double reach = 0;
    for (const RobotChoice& choice : choices_) reach = std::max(reach, choice.shape->reach);
    for (const RobotChoice& choice : choices_) {
        const QPixmap picture = pictureOf(*choice.shape, reach, devicePixelRatioF());
        auto* item = new QListWidgetItem(QIcon(picture), choiceText(choice), robots_);
        item->setToolTip(qtText(choice.file));
    }
    open_->setEnabled(!choices_.empty());
    robots_->setCurrentRow(current);
}

void RobotDialog::choose(const QString& robotFile) {
    const std::string file = robotFile.toStdString();
    auto found =
        std::find_if(choices_.begin(), choices_.end(), [&](const RobotChoice& choice) { return choice.file == file; });
    error_->hide();
    error_->clear();
    if (found == choices_.end()) {
        auto choice = robotChoiceOf(file);
        if (!choice) {
            error_->setText(qtText(choice.error().message()));
            return error_->show();
        }
        found = choices_.insert(choices_.end(), std::move(*choice));
        fill();
    }
    robots_->setCurrentRow(static_cast<int>(found - choices_.begin()));
    robots_->setFocus();
}

void RobotDialog::askForFile() {
    const QString file = QFileDialog::getOpenFileName(this, tr("Robot file"), QFileInfo(log_).path(),
                                                      tr("Robots (*.toml);;All files (*)"));
    if (!file.isEmpty()) choose(file);
}

void RobotDialog::accept() {
    const int row = robots_->currentRow();
    if (row < 0) return;
    QDialog::accept();
    emit chosen(qtText(choices_[static_cast<std::size_t>(row)].file));
}

}  // namespace mrose::gui
