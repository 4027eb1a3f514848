#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "io/error.h"
#include "learning/learned_network.h"

namespace mrose {

class TomlTable;

/// The text of a network file (TOML), exact to the bit; nets/README.md explains it. `section`: what only this kind of
/// network says, as the text of tables whose names begin with the kind's: "[motion]\nform = ...\n".
std::string networkFileText(const LearnedNetwork& network, std::string_view section);

/// Reads the section of a kind, once all but the layers is read. What does not fit is rejected in the table.
using NetworkSectionReader = std::function<void(TomlTable& section, const LearnedNetwork& network)>;

/// Reads the network file of one kind whose root this is. Error: file, line, column and key of the first thing that
/// does not fit; another kind of network; no network at all; another family than those that the kind knows.
Expected<LearnedNetwork> readNetworkFile(TomlTable& root, std::string_view kind,
                                         const NetworkSectionReader& readSection,
                                         std::span<const std::string_view> families = regressorFamilyNames);

/// The kind that a network file says it is of; "" where its text is no network file.
std::string networkKind(std::string_view text);

/// The keys of [training], for readers of other files that have such a part. For .cpp files of loaders.
NetworkTraining readNetworkTraining(TomlTable table);
/// The matrices and vectors of [layers].
Mlp readNetworkLayers(TomlTable table, const MlpShape& shape);
/// `groups` or `blocks` of [held_out], where it has one of them.
HoldOut readHoldOut(TomlTable& table);

}  // namespace mrose
