#pragma once

#include <QDialog>

#include "export/exports.h"
#include "export/sequence_export.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace mrose::gui {

/// Which stretch of time is to become a film or pictures, and how. It stays open beside the window.
class FilmDialog final : public QDialog {
    Q_OBJECT

public:
    FilmDialog(const Exports& exports, bool film);

    void setFilm(bool film);
    SequenceSettings settings() const;
    /// Begins the export; what is wrong is said in the dialogue. False: it did not begin.
    bool exportTo(const QString& path);

private:
    void fill();
    void ask();
    void refresh();
    void say(const QString& text, bool wrong);

    const Exports& exports_;
    QComboBox *kind_, *what_, *size_;
    QDoubleSpinBox *from_, *to_, *speed_, *rate_;
    QLabel* summary_;
    QPushButton* export_;
};

/// The window's only one; its stretch is all that is known.
FilmDialog* showFilmDialog(const Exports& exports, bool film);

}  // namespace mrose::gui
