#include "common.h"

namespace mrose::cli {

Subcommand addGenerate(CLI::App& app, CommonFlags& flags) {
    CLI::App* sub = addSubcommand(app, flags, "generate", "Make synthetic logs", "");
    return {sub, [] { return failure; }};
}

}  // namespace mrose::cli
