#include "widgets/message_bar.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QStyle>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

namespace mrose {
namespace {

constexpr int signSize = 16, stripe = 3, widestButton = 220;  // pixels

/// A disc with "!" or "i".
QPixmap sign(MessageBar::Kind kind, const Theme& theme, double ratio) {
    QPixmap pixmap(QSize(signSize, signSize) * ratio);
    pixmap.setDevicePixelRatio(ratio);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(kind == MessageBar::Kind::error ? theme.warning : theme.accent);
    painter.drawEllipse(0, 0, signSize, signSize);
    painter.setBrush(theme.panel);
    const bool error = kind == MessageBar::Kind::error;
    painter.drawRoundedRect(QRectF(7, error ? 3.5 : 7, 2, 5.5), 1, 1);
    painter.drawEllipse(QPointF(8, error ? 11.7 : 4.6), 1.25, 1.25);
    return pixmap;
}

QPixmap cross(const QColor& colour, double ratio) {
    QPixmap pixmap(QSize(signSize, signSize) * ratio);
    pixmap.setDevicePixelRatio(ratio);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(colour, 1.6, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(QPointF(4.5, 4.5), QPointF(11.5, 11.5));
    painter.drawLine(QPointF(4.5, 11.5), QPointF(11.5, 4.5));
    return pixmap;
}

}  // namespace

class MessageBar::Line final : public QWidget {
public:
    Line(MessageBar& bar, Message message) : QWidget(&bar), message_(std::move(message)) {
        auto* layout = new QHBoxLayout(this);
        layout->setContentsMargins(stripe + 10, 5, 6, 5);
        layout->setSpacing(8);
        sign_ = new QLabel(this);
        sign_->setFixedSize(signSize, signSize);
        layout->addWidget(sign_);
        text_ = new QLabel(message_.text, this);
        text_->setObjectName("message_text");
        text_->setTextFormat(Qt::PlainText);
        text_->setWordWrap(true);
        text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
        text_->setFocusPolicy(Qt::ClickFocus);
        layout->addWidget(text_, 1);
        if (message_.kind == Kind::progress) {
            progress_ = new QProgressBar(this);
            progress_->setFixedSize(160, 10);
            progress_->setTextVisible(false);
            layout->addWidget(progress_);
            progressTo(message_.text, message_.share);
        }
        for (const Button& button : message_.buttons) addButton(*layout, button);
        more_ = new QToolButton(this);
        more_->setObjectName("more_notes");
        more_->setAutoRaise(true);
        more_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
        more_->hide();
        layout->addWidget(more_);
        QObject::connect(more_, &QToolButton::clicked, &bar, [&bar] {
            bar.open_ = !bar.open_;
            bar.fold();
        });
        close_ = new QToolButton(this);
        close_->setObjectName("dismiss");
        close_->setAutoRaise(true);
        close_->setToolTip(tr("Dismiss"));
        close_->setAccessibleName(tr("Dismiss"));
        close_->setVisible(message_.kind != Kind::progress);
        layout->addWidget(close_);
        QObject::connect(close_, &QToolButton::clicked, &bar, [&bar, this] {
            const auto found = std::find(bar.lines_.begin(), bar.lines_.end(), this);
            if (found != bar.lines_.end()) bar.drop(static_cast<std::size_t>(found - bar.lines_.begin()));
        });
        const char* const kinds[] = {"note", "error", "progress"};
        setObjectName(kinds[static_cast<int>(message_.kind)]);
        setAccessibleName(message_.text);
    }

    const Message& message() const { return message_; }
    int heightIn(int width) const { return layout()->totalHeightForWidth(width); }
    /// Offers so many older notes, or to fold them again.
    void offer(std::size_t older, bool open) {
        more_->setVisible(older > 0);
        more_->setArrowType(open ? Qt::UpArrow : Qt::DownArrow);
        more_->setText(open ? tr("Fold") : tr("%1 more").arg(older));
        more_->setToolTip(open ? tr("Show only this message") : tr("Show the other messages, too"));
    }
    void progressTo(const QString& text, double share) {
        message_.text = text;
        message_.share = share;
        text_->setText(text);
        progress_->setRange(0, share < 0 ? 0 : 1000);
        progress_->setValue(share < 0 ? 0 : static_cast<int>(1000 * share));
    }
    void setTheme(const Theme& theme) {
        theme_ = theme;
        sign_->setPixmap(sign(message_.kind, theme, devicePixelRatioF()));
        close_->setIcon(QIcon(cross(theme.quietText, devicePixelRatioF())));
        update();
    }

protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        const QColor colour = message_.kind == Kind::error ? theme_.warning : theme_.accent;
        painter.fillRect(rect(), mixed(theme_.panel, colour, theme_.dark ? 0.16 : 0.09));
        painter.fillRect(0, 0, stripe, height(), colour);
        painter.fillRect(0, height() - 1, width(), 1, theme_.line);
    }

private:
    void addButton(QHBoxLayout& layout, const Button& button) {
        auto* made = new QPushButton(this);
        const QString text = made->fontMetrics().elidedText(button.text, Qt::ElideMiddle, widestButton);
        made->setText(text);
        made->setToolTip(text == button.text ? button.tip : button.text + '\n' + button.tip);
        made->setMinimumWidth(made->sizeHint().width() + 16);
        // A copy: what it does may well remove this line.
        QObject::connect(made, &QPushButton::clicked, this, [run = button.run] {
            const std::function<void()> once = run;
            once();
        });
        layout.addWidget(made);
    }

    Message message_;
    Theme theme_ = Theme::light();
    QLabel *sign_, *text_;
    QProgressBar* progress_ = nullptr;
    QToolButton *more_, *close_;
};

MessageBar::MessageBar(QWidget* parent) : QWidget(parent), layout_(new QVBoxLayout(this)) {
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(0);
    setAccessibleName(tr("Messages"));
    hide();
}

void MessageBar::standOver(QWidget& host) {
    setParent(&host);
    host.installEventFilter(this);
    place();
}

void MessageBar::place() {
    const QWidget* host = parentWidget();
    if (host == nullptr || lines_.empty()) return;
    if (host->layout() != nullptr && host->layout()->indexOf(this) >= 0) return;
    const int wide = host->width();
    setGeometry(0, 0, wide, layout_->hasHeightForWidth() ? layout_->totalHeightForWidth(wide) : sizeHint().height());
    raise();
}

bool MessageBar::event(QEvent* event) {
    const bool done = QWidget::event(event);
    if (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Show) place();
    return done;
}

bool MessageBar::eventFilter(QObject* watched, QEvent* event) {
    if (watched == parentWidget() && event->type() == QEvent::Resize) {
        place();
        fold();
    }
    return QWidget::eventFilter(watched, event);
}

void MessageBar::add(Message message) {
    for (std::size_t i = lines_.size(); i-- > 0;) {
        const Message& there = lines_[i]->message();
        const bool same = message.topic.isEmpty() ? there.topic.isEmpty() && there.text == message.text
                                                  : there.topic == message.topic;
        if (!same) continue;
        // What goes on stays where it is.
        if (message.kind == Kind::progress && there.kind == Kind::progress)
            return lines_[i]->progressTo(message.text, message.share);
        drop(i);
    }
    const Kind kind = message.kind;
    const QString text = message.text;
    auto* line = new Line(*this, std::move(message));
    line->setTheme(theme_);
    lines_.push_back(line);
    layout_->addWidget(line);
    makeRoom();
    fold();
    show();
    emit added(kind, text);
}

void MessageBar::makeRoom() {
    while (lines_.size() > most) {
        const auto oldest = [this](Kind kind) {
            return std::find_if(lines_.begin(), lines_.end() - 1,
                                [kind](const Line* line) { return line->message().kind == kind; });
        };
        auto found = oldest(Kind::note);
        if (found == lines_.end() - 1) found = oldest(Kind::error);
        drop(static_cast<std::size_t>(found - lines_.begin()));
    }
}

void MessageBar::drop(std::size_t index) {
    Line* line = lines_[index];
    lines_.erase(lines_.begin() + static_cast<std::ptrdiff_t>(index));
    layout_->removeWidget(line);
    line->hide();
    line->deleteLater();
    fold();
    setVisible(!lines_.empty());
}

/// What it stands over is to be seen below: there all fold into one, otherwise notes alone.
void MessageBar::fold() {
    const QWidget* host = parentWidget();
    const bool tight = host != nullptr && heightOfAll() > mostHidden * host->height();
    std::vector<Line*> notes, errors;
    for (Line* line : lines_) {
        if (line->message().kind == Kind::note) notes.push_back(line);
        if (line->message().kind == Kind::error) errors.push_back(line);
    }
    if (tight) notes.insert(notes.end(), errors.begin(), errors.end());
    const bool many = notes.size() > (tight ? 1 : mostNotes);
    open_ = open_ && many;
    for (Line* line : errors) line->setVisible(true);
    for (Line* line : notes) {
        const bool last = line == notes.back();
        line->setVisible(last || open_ || !many);
        line->offer(last && many ? notes.size() - 1 : 0, open_);
    }
    if (!tight)
        for (Line* line : errors) line->offer(0, false);
}

int MessageBar::heightOfAll() const {
    int height = 0;
    for (const Line* line : lines_) height += line->heightIn(parentWidget()->width());
    return height;
}

void MessageBar::remove(const QString& topic) {
    for (std::size_t i = lines_.size(); i-- > 0;)
        if (lines_[i]->message().topic == topic) drop(i);
}

void MessageBar::clear() {
    while (!lines_.empty()) drop(lines_.size() - 1);
}

bool MessageBar::dismiss() {
    for (std::size_t i = lines_.size(); i-- > 0;) {
        if (lines_[i]->message().kind == Kind::progress || lines_[i]->isHidden()) continue;
        drop(i);
        return true;
    }
    return false;
}

std::vector<MessageBar::Message> MessageBar::messages() const {
    std::vector<Message> messages;
    for (const Line* line : lines_) messages.push_back(line->message());
    return messages;
}

bool MessageBar::has(const QString& topic) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](const Line* line) { return line->message().topic == topic; });
}

void MessageBar::setTheme(const Theme& theme) {
    theme_ = theme;
    for (Line* line : lines_) line->setTheme(theme_);
}

}  // namespace mrose
