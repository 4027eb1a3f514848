#include "io/caught.h"

#include <exception>
#include <new>

namespace mrose {

Error thrownError() {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        return {{}, 0, 0, {}, "needs more memory than this computer has"};
    } catch (const std::exception& error) {
        return {{}, 0, 0, {}, std::string("failed: ") + error.what()};
    } catch (...) {
        return {{}, 0, 0, {}, "failed for an unknown reason"};
    }
}

}  // namespace mrose
