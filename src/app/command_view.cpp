// scanout view: the viewer.
#include "app/commands.h"

namespace scanout::app {

Result<Exit> run_view(const Settings&, std::uint64_t) {
    return fail(Exit::no_display, "the viewer is not part of this build; use `scanout render`");
}

} // namespace scanout::app
