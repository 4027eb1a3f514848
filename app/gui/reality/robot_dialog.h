#pragma once

#include <QDialog>
#include <memory>
#include <vector>

#include "geometry/shape.h"
#include "io/error.h"

class QLabel;
class QListWidget;
class QPushButton;

namespace mrose::gui {

/// What a robot file describes, as far as it distinguishes robots.
struct RobotChoice {
    std::string file;  ///< as PlayedLogRequest::robotFile has it: a path, or the name of one that ships
    std::string name;
    std::shared_ptr<const Shape> shape;
    double length = 0, width = 0;  ///< m, of its outline
    std::string motion;            ///< how it moves, for people
    double deadTime = 0;           ///< s
};

/// Error: the first thing wrong with the file; it describes something else.
Expected<RobotChoice> robotChoiceOf(const std::string& file);
std::vector<RobotChoice> robotsThatShip();  ///< by their names

/// What drove in a log that does not say it? A robot that ships, or one of a file.
class RobotDialog final : public QDialog {
    Q_OBJECT

public:
    explicit RobotDialog(const QString& log, QWidget* parent = nullptr);

    QListWidget& robots() const { return *robots_; }
    QString error() const;
    /// Makes it the list's current one; a file that is not in the list yet comes into it. What is wrong is said.
    void choose(const QString& robotFile);

signals:
    void chosen(const QString& robotFile);

protected:
    void accept() override;

private:
    void fill();
    void askForFile();

    QString log_;
    std::vector<RobotChoice> choices_;
    QListWidget* robots_;
    QLabel* error_;
    QPushButton* open_;
};

}  // namespace mrose::gui
