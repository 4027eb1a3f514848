#include "export/view_export.h"

#include <QBuffer>
#include <QFileInfo>
#include <QImage>
#include <QPageSize>
#include <QPdfWriter>
#include <QStringList>
#include <QSvgGenerator>
#include <QWidget>

#include "frame/actions.h"
#include "io/file.h"

namespace mrose::gui {
namespace {

constexpr double metresPerInch = 0.0254, pointsPerInch = 72;

bool paintOn(QPaintDevice& device, const Picture& picture) {
    QPainter painter;
    if (!painter.begin(&device)) return false;
    picture.paint(painter);
    return painter.end();
}

bool drawPng(QBuffer& buffer, const Picture& picture, int pixels) {
    QImage image(picture.size * pixels, QImage::Format_RGB32);
    if (image.isNull()) return false;
    image.setDevicePixelRatio(pixels);
    image.fill(Qt::white);
    if (!paintOn(image, picture)) return false;
    const int dotsPerMetre = static_cast<int>(pixels * picture.perInch / metresPerInch);
    image.setDotsPerMeterX(dotsPerMetre);
    image.setDotsPerMeterY(dotsPerMetre);
    image.setText("Title", picture.title);
    return image.save(&buffer, "PNG");
}

bool drawSvg(QBuffer& buffer, const Picture& picture) {
    QSvgGenerator svg;
    svg.setOutputDevice(&buffer);
    svg.setResolution(picture.perInch);
    svg.setSize(picture.size);
    svg.setViewBox(QRect({}, picture.size));
    svg.setTitle(picture.title);
    return paintOn(svg, picture);
}

bool drawPdf(QBuffer& buffer, const Picture& picture) {
    QPdfWriter pdf(&buffer);
    pdf.setResolution(picture.perInch);
    const QSizeF points = QSizeF(picture.size) * pointsPerInch / picture.perInch;
    pdf.setPageSize(QPageSize(points, QPageSize::Point, QString(), QPageSize::ExactMatch));
    pdf.setPageMargins({0, 0, 0, 0});
    pdf.setTitle(picture.title);
    pdf.setCreator("mrose");
    return paintOn(pdf, picture);
}

tl::unexpected<Error> noPicture(const QString& path) {
    return fail(path.toStdString(), "is no kind of picture that can be written; expected .png, .svg or .pdf");
}

}  // namespace

Expected<void> checkPicture(const QString& path) {
    if (!QStringList{"png", "svg", "pdf"}.contains(QFileInfo(path).suffix().toLower())) return noPicture(path);
    return checkWritable(path.toStdString());
}

Expected<void> writePicture(const Picture& picture, const QString& path, int pixels) {
    const std::string name = path.toStdString();
    const QString extension = QFileInfo(path).suffix().toLower();
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    bool drawn = false;
    if (extension == "png")
        drawn = drawPng(buffer, picture, pixels);
    else if (extension == "svg")
        drawn = drawSvg(buffer, picture);
    else if (extension == "pdf")
        drawn = drawPdf(buffer, picture);
    else
        return noPicture(path);
    if (!drawn) return fail(name, "the picture could not be drawn");
    return writeFileAtomically(name, {bytes.constData(), static_cast<std::size_t>(bytes.size())});
}

Expected<void> writeWidget(QWidget& widget, const QString& path) {
    const auto paint = [&widget](QPainter& painter) {
        widget.render(&painter, {}, {}, QWidget::DrawWindowBackground | QWidget::DrawChildren);
    };
    return writePicture({widget.size(), widget.logicalDpiX(), widget.window()->windowTitle(), paint}, path,
                        qRound(widget.devicePixelRatioF()));
}

}  // namespace mrose::gui
