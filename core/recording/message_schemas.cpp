#include "recording/message_schemas.h"

#include "recording/state_messages.h"

namespace mrose {
namespace {

const char* const number = R"({"type":"number"})";
const char* const text = R"({"type":"string"})";
const char* const flag = R"({"type":"boolean"})";
const char* const bytes = R"({"type":"string","contentEncoding":"base64"})";
const char* const count = R"({"type":"integer","minimum":0})";

std::string property(const std::string& name, const std::string& schema) { return '"' + name + "\":" + schema; }

/// "name":schema, of each of the names between commas.
std::string properties(const std::string& names, const std::string& schema) {
    std::string all;
    for (std::size_t begin = 0; begin < names.size();) {
        const std::size_t end = std::min(names.find(',', begin), names.size());
        all += (all.empty() ? "" : ",") + property(names.substr(begin, end - begin), schema);
        begin = end + 1;
    }
    return all;
}

std::string objectSchema(const std::string& title, const std::string& content) {
    return R"({"title":")" + title + R"(","type":"object","properties":{)" + content + "}}";
}

std::string arraySchema(const std::string& items) { return R"({"type":"array","items":)" + items + '}'; }

std::string time(const char* title) {
    const bool instant = std::string(title) == "time";
    return std::string(R"({"type":"object","title":")") + title + R"(","properties":{"sec":)" +
           (instant ? count : R"({"type":"integer"})") +
           R"(,"nsec":{"type":"integer","minimum":0,"maximum":999999999}}})";
}

std::string vector3() { return objectSchema("foxglove.Vector3", properties("x,y,z", number)); }
std::string point3() { return objectSchema("foxglove.Point3", properties("x,y,z", number)); }
std::string quaternion() { return objectSchema("foxglove.Quaternion", properties("x,y,z,w", number)); }
std::string colour() { return objectSchema("foxglove.Color", properties("r,g,b,a", number)); }

std::string pose() {
    return objectSchema("foxglove.Pose", property("position", vector3()) + ',' + property("orientation", quaternion()));
}

std::string choice(const std::string& title, const std::string& names) {
    std::string values;
    int value = 0;
    for (std::size_t begin = 0; begin < names.size(); ++value) {
        const std::size_t end = std::min(names.find(',', begin), names.size());
        values += (value > 0 ? "," : "") + std::string(R"({"title":")") + names.substr(begin, end - begin) +
                  R"(","const":)" + std::to_string(value) + '}';
        begin = end + 1;
    }
    return R"({"title":")" + title + R"(","oneOf":[)" + values + "]}";
}

/// An array of primitives, all of which have a pose first.
std::string primitives(const std::string& name, const std::string& title, const std::string& rest) {
    return property(name, arraySchema(objectSchema("foxglove." + title, property("pose", pose()) + ',' + rest)));
}

std::string entity() {
    const std::string sized = property("size", vector3()) + ',' + property("color", colour());
    const std::string points = property("points", arraySchema(point3())) + ',' + property("color", colour()) + ',' +
                               property("colors", arraySchema(colour())) + ',' +
                               property("indices", arraySchema(count));
    return objectSchema(
        "foxglove.SceneEntity",
        property("timestamp", time("time")) + ',' + properties("frame_id,id", text) + ',' +
            property("lifetime", time("duration")) + ',' + property("frame_locked", flag) + ',' +
            property("metadata", arraySchema(objectSchema("foxglove.KeyValuePair", properties("key,value", text)))) +
            ',' +
            primitives("arrows", "ArrowPrimitive",
                       properties("shaft_length,shaft_diameter,head_length,head_diameter", number) + ',' +
                           property("color", colour())) +
            ',' + primitives("cubes", "CubePrimitive", sized) + ',' + primitives("spheres", "SpherePrimitive", sized) +
            ',' +
            primitives("cylinders", "CylinderPrimitive",
                       property("size", vector3()) + ',' + properties("bottom_scale,top_scale", number) + ',' +
                           property("color", colour())) +
            ',' +
            property("lines", arraySchema(objectSchema(
                                  "foxglove.LinePrimitive",
                                  property("type", choice("foxglove.LineType", "LINE_STRIP,LINE_LOOP,LINE_LIST")) +
                                      ',' + property("pose", pose()) + ',' + property("thickness", number) + ',' +
                                      property("scale_invariant", flag) + ',' + points))) +
            ',' + primitives("triangles", "TriangleListPrimitive", points) + ',' +
            primitives("texts", "TextPrimitive",
                       property("billboard", flag) + ',' + property("font_size", number) + ',' +
                           property("scale_invariant", flag) + ',' + property("color", colour()) + ',' +
                           property("text", text)) +
            ',' +
            primitives("models", "ModelPrimitive",
                       property("scale", vector3()) + ',' + property("color", colour()) + ',' +
                           property("override_color", flag) + ',' + properties("url,media_type", text) + ',' +
                           property("data", bytes)));
}

/// A property of numbers for each of some robots, or objects.
std::string bodies(const std::string& title, std::span<const std::string> names, bool robots) {
    std::string numbers;
    for (const Quantity* quantity : sampledQuantities(robots)) numbers += std::string(quantity->name) + ',';
    std::string all;
    for (const std::string& name : names)
        all += (all.empty() ? "" : ",") + property(name, objectSchema(title, properties(numbers + "pressed", number)));
    return all;
}

}  // namespace

std::string frameTransformsSchema() {
    return objectSchema(
        "foxglove.FrameTransforms",
        property("transforms",
                 arraySchema(objectSchema(
                     "foxglove.FrameTransform",
                     property("timestamp", time("time")) + ',' + properties("parent_frame_id,child_frame_id", text) +
                         ',' + property("translation", vector3()) + ',' + property("rotation", quaternion())))));
}

std::string sceneUpdateSchema() {
    const std::string deletion =
        objectSchema("foxglove.SceneEntityDeletion",
                     property("timestamp", time("time")) + ',' +
                         property("type", choice("foxglove.SceneEntityDeletionType", "MATCHING_ID,ALL")) + ',' +
                         property("id", text));
    return objectSchema("foxglove.SceneUpdate", property("deletions", arraySchema(deletion)) + ',' +
                                                    property("entities", arraySchema(entity())));
}

std::string logSchema() {
    return objectSchema("foxglove.Log",
                        property("timestamp", time("time")) + ',' +
                            property("level", choice("foxglove.LogLevel", "UNKNOWN,DEBUG,INFO,WARNING,ERROR,FATAL")) +
                            ',' + properties("message,name,file", text) + ',' + property("line", count));
}

std::string laserScanSchema() {
    return objectSchema("foxglove.LaserScan", property("timestamp", time("time")) + ',' + property("frame_id", text) +
                                                  ',' + property("pose", pose()) + ',' +
                                                  properties("start_angle,end_angle", number) + ',' +
                                                  properties("ranges,intensities", arraySchema(number)));
}

std::string pointCloudSchema() {
    const std::string field = objectSchema(
        "foxglove.PackedElementField",
        property("name", text) + ',' + property("offset", count) + ',' +
            property("type",
                     choice("foxglove.NumericType", "UNKNOWN,UINT8,INT8,UINT16,INT16,UINT32,INT32,FLOAT32,FLOAT64")));
    return objectSchema("foxglove.PointCloud",
                        property("timestamp", time("time")) + ',' + property("frame_id", text) + ',' +
                            property("pose", pose()) + ',' + property("point_stride", count) + ',' +
                            property("fields", arraySchema(field)) + ',' + property("data", bytes));
}

std::string readingTitle(const RecordType& type) { return "mrose.Reading." + type.name; }

std::string readingSchema(const RecordType& type) {
    std::string fields;
    for (const RecordField& field : type.fields)
        fields += (fields.empty() ? "" : ",") + property(field.name, field.count == 1 ? number : arraySchema(number));
    return objectSchema(readingTitle(type), property("timestamp", time("time")) + ',' +
                                                property("records", arraySchema(objectSchema("", fields))));
}

std::string radioSchema() {
    const std::string message = properties("from,to", text) + ',' + properties("kind,size", count) + ',' +
                                property("bytes", text) + ',' + property("sent_s", number);
    return objectSchema("mrose.Radio",
                        property("timestamp", time("time")) + ',' +
                            property("sent", arraySchema(objectSchema("mrose.SentMessage", message))) + ',' +
                            property("due", arraySchema(objectSchema("mrose.DueMessage",
                                                                     message + ',' + property("outcome", text) + ',' +
                                                                         properties("arrival_ms,late_ms", number)))) +
                            ',' + property("left_out", count));
}

std::string bodiesSchema(std::span<const std::string> robots, std::span<const std::string> objects) {
    std::string all = bodies("mrose.Robot", robots, true);
    if (!robots.empty() && !objects.empty()) all += ',';
    return objectSchema("mrose.Bodies", all + bodies("mrose.Object", objects, false));
}

}  // namespace mrose
