#include "logs/mrclam_measurements.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/file.h"
#include "io/format.h"
#include "logs/looks.h"
#include "logs/mrclam_rows.h"

namespace mrose {
namespace {

constexpr const char *barcodeFile = "Barcodes.dat", *landmarkFile = "Landmark_Groundtruth.dat";

/// Numbers of barcodes and subjects before it is known whether they are whole.
struct BarcodeRow {
    Nanoseconds time = 0;
    double barcode = 0, range = 0, bearing = 0;
};
struct SubjectRow {
    double subject = 0, barcode = 0;
};
struct LandmarkRow {
    double subject = 0;
    Point position;
};

constexpr MrclamLayout<BarcodeRow, 4> measurementLayout{{"time", "barcode", "range", "bearing"},
                                                        [](BarcodeRow& row, const double* numbers) {
                                                            row.barcode = numbers[0];
                                                            row.range = numbers[1];
                                                            row.bearing = numbers[2];
                                                        }};
constexpr MrclamLayout<SubjectRow, 2> barcodeLayout{{"subject", "barcode"}, [](SubjectRow& row, const double* numbers) {
                                                        row = {numbers[0], numbers[1]};
                                                    }};
constexpr MrclamLayout<LandmarkRow, 5> landmarkLayout{{"subject", "x", "y", "x std-dev", "y std-dev"},
                                                      [](LandmarkRow& row, const double* numbers) {
                                                          row = {numbers[0], {numbers[1], numbers[2]}};
                                                      }};

bool isWhole(double number) { return number == std::floor(number) && std::abs(number) <= largestNumber; }
std::string notWholeCause(double number) { return "expected a whole number, found " + numberText(number); }

/// The first column of numbers that are not whole, or that are named twice.
class NameCheck {
public:
    explicit NameCheck(const char* key) : key_(key) {}
    std::string cause(double number) {
        if (!isWhole(number)) return notWholeCause(number);
        return seen_.insert(number).second ? "" : fixed(number, 0) + " is there twice";
    }
    const char* key() const { return key_; }

private:
    const char* key_;
    std::set<double> seen_;
};

/// What one row of readings says of itself: a column and what is wrong with it.
std::pair<const char*, std::string> wrongColumn(const BarcodeRow& row) {
    if (!isWhole(row.barcode)) return {"barcode", notWholeCause(row.barcode)};
    if (const std::string cause = wrongRange(row.range); !cause.empty()) return {"range", cause};
    return {"bearing", wrongBearing(row.bearing)};
}

/// The content of a file that exists; it is one of those that the log's measurements are read from.
Expected<std::string> readMeasurementFile(Log& log, const std::filesystem::path& path) {
    auto content = readFile(path);
    if (content) log.measurementFiles.push_back({path.string(), contentHash(*content)});
    return content;
}

/// Subjects by the barcodes that they carry.
using BarcodeSubjects = std::map<int, std::size_t>;

Expected<BarcodeSubjects> readSubjects(Log& log, const std::filesystem::path& folder) {
    SensorDefects defects;
    const auto barcodeText = readMeasurementFile(log, folder / barcodeFile);
    if (!barcodeText) return tl::unexpected(barcodeText.error());
    const auto barcodes = parseMrclamBarcodes(*barcodeText, (folder / barcodeFile).string(), defects);
    if (!barcodes) return tl::unexpected(barcodes.error());
    const auto landmarkText = readMeasurementFile(log, folder / landmarkFile);
    if (!landmarkText) return tl::unexpected(landmarkText.error());
    const auto landmarks = parseMrclamLandmarks(*landmarkText, (folder / landmarkFile).string(), defects);
    if (!landmarks) return tl::unexpected(landmarks.error());
    BarcodeSubjects subjects;
    for (const SubjectBarcode& carried : *barcodes) {
        const auto landmark = std::find_if(landmarks->begin(), landmarks->end(), [&](const LandmarkPosition& known) {
            return known.subject == carried.subject;
        });
        LogSubject subject{.name = std::to_string(carried.subject)};
        if (landmark != landmarks->end())
            subject.position = landmark->position;
        else
            subject.kind = LogSubject::Kind::robot, subject.robot = subject.name;
        subjects.emplace(carried.barcode, log.subjects.size());
        log.subjects.push_back(std::move(subject));
    }
    return subjects;
}

SensorLog cameraOf(const std::vector<BarcodeReading>& rows, const BarcodeSubjects& subjects, SensorDefects defects) {
    SensorLog camera{.sensor = mrclamCamera, .defects = defects};
    std::vector<StampedReading> readings;
    readings.reserve(rows.size());
    for (const BarcodeReading& row : rows) {
        const auto subject = subjects.find(row.barcode);
        StampedReading& reading = readings.emplace_back(StampedReading{row.time, {}});
        if (subject != subjects.end())
            reading.reading = LogReading{subject->second, row.range, row.bearing};
        else
            ++camera.defects.unknownSubjects;
    }
    camera.looks = joinLooks(std::move(readings), lookSpan, camera.defects);
    addEmptyLooks(camera.looks, mrclamCameraPeriod, camera.defects);
    return camera;
}

// Now and then a camera misreads a barcode: so few of a robot's readings are no sign of a wrong file.
constexpr std::size_t fewUnknown = 5;
constexpr double fewUnknownShare = 0.01;

using BarcodeRows = MrclamRows<BarcodeRow, 4>;

/// What to say of readings whose barcodes nobody carries; "" of few.
std::string unknownText(const std::vector<BarcodeReading>& rows, const BarcodeSubjects& subjects,
                        const std::string& file, const BarcodeRows& lines) {
    std::set<int> unknown;
    std::size_t count = 0, first = rows.size();
    for (std::size_t row = 0; row < rows.size(); ++row) {
        if (subjects.contains(rows[row].barcode)) continue;
        first = std::min(first, row);
        unknown.insert(rows[row].barcode);
        ++count;
    }
    if (count <= fewUnknown || static_cast<double>(count) <= fewUnknownShare * static_cast<double>(rows.size()))
        return "";
    return file + ':' + std::to_string(lines.lineOf(first)) + ": barcode " + std::to_string(rows[first].barcode) +
           (unknown.size() > 1 ? ", and " + counted(unknown.size() - 1, "other") + ", are nobody's in "
                               : std::string(" is nobody's in ")) +
           barcodeFile + ": " + std::to_string(count) + " of " + counted(rows.size(), "reading") + " dropped.";
}

std::filesystem::path measurementFile(const std::filesystem::path& folder, const RobotLog& robot) {
    return folder / ("Robot" + robot.robot + "_Measurement.dat");
}

Expected<void> readCamera(Log& log, RobotLog& robot, const std::filesystem::path& path,
                          const BarcodeSubjects& subjects) {
    const auto content = readMeasurementFile(log, path);
    if (!content) return tl::unexpected(content.error());
    SensorDefects defects;
    const auto rows = parseMrclamMeasurements(*content, path.string(), defects);
    if (!rows) return tl::unexpected(rows.error());
    if (defects.cutLines > 0) log.incomplete.push_back(cutLineText(path.string()));
    if (rows->empty()) {
        log.incomplete.push_back(tooShortText(path.string(), 0) + ": nothing says what robot " + robot.robot + " saw.");
        return {};
    }
    Trajectory& trajectory = robot.trajectories.front();
    SensorLog camera = cameraOf(*rows, subjects, defects);
    const BarcodeRows lines(*content, path.string(), measurementLayout);
    if (!sharesTime(camera, trajectory))
        return fail(path.string(), otherTimeCause(camera, trajectory), lines.lineOf(0), "time");
    if (std::string unknown = unknownText(*rows, subjects, path.filename().string(), lines); !unknown.empty())
        log.incomplete.push_back(std::move(unknown));
    trajectory.sensors.push_back(std::move(camera));
    return {};
}

}  // namespace

Expected<std::vector<BarcodeReading>> parseMrclamMeasurements(std::string_view content, const std::string& name,
                                                              SensorDefects& defects) {
    BarcodeRows file(content, name, measurementLayout);
    const auto rows = file.parse(defects.cutLines);
    if (!rows) return tl::unexpected(rows.error());
    std::vector<BarcodeReading> readings;
    readings.reserve(rows->size());
    for (const BarcodeRow& row : *rows) {
        const auto& [column, cause] = wrongColumn(row);
        if (!cause.empty()) return fail(name, cause, file.lineOf(readings.size()), column);
        readings.push_back({row.time, static_cast<int>(row.barcode), row.range, row.bearing});
    }
    return readings;
}

Expected<std::vector<SubjectBarcode>> parseMrclamBarcodes(std::string_view content, const std::string& name,
                                                          SensorDefects& defects) {
    MrclamRows<SubjectRow, 2> file(content, name, barcodeLayout);
    const auto rows = file.parse(defects.cutLines);
    if (!rows) return tl::unexpected(rows.error());
    NameCheck subjects("subject"), barcodes("barcode");
    std::vector<SubjectBarcode> carried;
    for (const SubjectRow& row : *rows) {
        for (auto& [check, number] : {std::pair(&subjects, row.subject), std::pair(&barcodes, row.barcode)})
            if (const std::string cause = check->cause(number); !cause.empty())
                return fail(name, cause, file.lineOf(carried.size()), check->key());
        carried.push_back({static_cast<int>(row.subject), static_cast<int>(row.barcode)});
    }
    return carried;
}

Expected<std::vector<LandmarkPosition>> parseMrclamLandmarks(std::string_view content, const std::string& name,
                                                             SensorDefects& defects) {
    MrclamRows<LandmarkRow, 5> file(content, name, landmarkLayout);
    const auto rows = file.parse(defects.cutLines);
    if (!rows) return tl::unexpected(rows.error());
    NameCheck subjects("subject");
    std::vector<LandmarkPosition> landmarks;
    for (const LandmarkRow& row : *rows) {
        if (const std::string cause = subjects.cause(row.subject); !cause.empty())
            return fail(name, cause, file.lineOf(landmarks.size()), subjects.key());
        landmarks.push_back({static_cast<int>(row.subject), row.position});
    }
    return landmarks;
}

Expected<void> readMrclamMeasurements(Log& log, const std::filesystem::path& folder) {
    const auto isThere = [](const std::filesystem::path& path) {
        std::error_code ignored;
        return std::filesystem::exists(path, ignored);
    };
    std::vector<std::string> without;
    for (const RobotLog& robot : log.robots)
        if (const auto path = measurementFile(folder, robot); !isThere(path))
            without.push_back(path.filename().string() + " is missing: nothing says what robot " + robot.robot +
                              " saw.");
    if (without.size() == log.robots.size()) return {};
    for (const char* const needed : {barcodeFile, landmarkFile})
        if (!isThere(folder / needed))
            return log.incomplete.push_back(std::string(needed) + " is missing: nothing says what the cameras saw."),
                   Expected<void>();
    const auto subjects = readSubjects(log, folder);
    if (!subjects) return tl::unexpected(subjects.error());
    log.incomplete.insert(log.incomplete.end(), without.begin(), without.end());
    for (RobotLog& robot : log.robots) {
        const auto path = measurementFile(folder, robot);
        if (!isThere(path)) continue;
        if (auto read = readCamera(log, robot, path, *subjects); !read) return read;
    }
    return {};
}

}  // namespace mrose
