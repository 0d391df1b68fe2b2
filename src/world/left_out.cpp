// Says which models are left out.
#include "world/left_out.h"

namespace roboss {

void report_left_out(const std::string& name, std::size_t count, const SourceLocation& where,
                     Diagnostics& diagnostics) {
    const std::size_t first = diagnostics.items().size();
    const std::string others = count > 1 ? ", and " + std::to_string(count - 1) + " more like it," : "";
    diagnostics.error(where, "left-out", "model '" + name + "'" + others + " is left out: it has errors",
                      "Mend them; --strict refuses such a world.");
    diagnostics.leave_out_since(first);
}

}  // namespace roboss
