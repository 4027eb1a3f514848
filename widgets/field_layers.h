#pragma once

#include <array>
#include <bitset>

namespace mrose {

/// What the field view can show beside the place and the bodies.
enum class FieldLayer {
    grid,
    names,
    headings,
    trails,
    targets,
    sensors,
    readings,
    laser,
    sonar,
    infrared,
    bumpers,
    lineCameras,
    radio,
    contacts,
    predicted,
    uncertainty,
    beliefs,
    ghosts,
    reality,
    models,
    legend,
    count,
};

struct FieldLayerText {
    FieldLayer layer;
    const char* action;            ///< by which it is switched
    const char *name, *key, *tip;  ///< as menus show it
    bool shown;                    ///< at first
};

inline constexpr std::array<FieldLayerText, static_cast<std::size_t>(FieldLayer::count)> fieldLayerTexts{{
    {FieldLayer::grid, "layer_grid", "Grid and ruler", "G", "Lines at every metre, or what suits the scale", false},
    {FieldLayer::names, "layer_names", "Names", "N", "Names of robots and objects", true},
    {FieldLayer::headings, "layer_headings", "Headings", "H", "Where robots face", true},
    {FieldLayer::trails, "layer_trails", "Trails", "T", "Where bodies came from", true},
    {FieldLayer::targets, "layer_notes", "Controllers' notes", "O", "Goals, lines and points that controllers annotate",
     true},
    {FieldLayer::sensors, "layer_sensors", "Sensor fields", "V", "How wide and far robots see", false},
    {FieldLayer::readings, "layer_readings", "Readings", "A",
     "What sensors reported last, from where they were: of all robots; without it of the selected one beside a real "
     "log",
     false},
    {FieldLayer::laser, "layer_laser", "Lasers", "1", "What laser scanners met last, and what their beams passed",
     true},
    {FieldLayer::sonar, "layer_sonar", "Sonars", "2", "From where the last echoes of sonars came", true},
    {FieldLayer::infrared, "layer_infrared", "Infrared", "3", "How much of their light infrared sensors got back last",
     true},
    {FieldLayer::bumpers, "layer_bumpers", "Bumpers", "4", "Bumpers' segments, and which of them are pressed", true},
    {FieldLayer::lineCameras, "layer_line_cameras", "Line cameras", "5",
     "The row of pixels that a line camera saw last, as a strip about its robot, and where the blobs in it are", true},
    {FieldLayer::radio, "layer_radio", "Radio", "W",
     "Messages of the last moments, from where they were sent to where they were received; crossed where they were "
     "lost, and barred where the range ends",
     false},
    {FieldLayer::contacts, "layer_contacts", "Contacts", "C", "Where bodies press on one another, and how hard", true},
    {FieldLayer::predicted, "layer_predicted", "Predicted paths", "P", "The next seconds, if all go on as commanded",
     true},
    {FieldLayer::uncertainty, "layer_uncertainty", "Uncertainty: 50 %, 90 %", "Q",
     "Where robots may be in the next seconds, by the noise of their motion: the inner band holds half of all runs, "
     "the "
     "outer one 90 %; beside a real log from the rollout's start on",
     false},
    {FieldLayer::beliefs, "layer_beliefs", "Beliefs", "B", "Where robots think that they and others are", false},
    {FieldLayer::ghosts, "layer_ghosts", "Ghosts", "J", "The same moment in other branches", true},
    {FieldLayer::reality, "layer_reality", "Reality", "R", "Where the real robots were at that time, by their log",
     true},
    {FieldLayer::models, "layer_models", "Models", "Y", "What other motion models make of the same commands", true},
    {FieldLayer::legend, "layer_legend", "Legend", "I", "What the layers' lines and signs stand for", false},
}};

class FieldLayers {
public:
    FieldLayers() {
        for (const FieldLayerText& text : fieldLayerTexts) set(text.layer, text.shown);
    }
    static FieldLayers none() {
        FieldLayers layers;
        layers.bits_.reset();
        return layers;
    }
    bool has(FieldLayer layer) const { return bits_[static_cast<std::size_t>(layer)]; }
    void set(FieldLayer layer, bool on) { bits_[static_cast<std::size_t>(layer)] = on; }
    bool operator==(const FieldLayers&) const = default;

private:
    std::bitset<static_cast<std::size_t>(FieldLayer::count)> bits_;
};

}  // namespace mrose
