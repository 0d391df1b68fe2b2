// Air resistance of a link. SDFormat only says whether the wind acts; how strongly is <roboss:drag>, or comes
// from the link's shapes.
#include "sdf/conversion.h"

namespace roboss::sdf_import {
namespace {

double at_least_0(const Element& drag, const char* child, double fallback, const Import& import) {
    if (!drag.child(child)) return fallback;
    const double value = import.reader.number(drag, child, 0.0);
    if (value >= 0) return value;
    import.diagnostics().error(drag.child(child).where(), "bad-value",
                               "<" + std::string(child) + "> of <roboss:drag> is negative",
                               "Write at least 0: drag takes energy, it never gives any.");
    return 0.0;
}

}  // namespace

void convert_drag(const Element& link, bool wind, const Import& import, LinkSpec& spec) {
    const Element drag = link.child("roboss:drag");
    spec.drag.wind = import.reader.boolean(link, "enable_wind", wind);
    spec.drag.acts = spec.drag.wind || drag;
    if (!drag) return;
    spec.drag.coefficient = at_least_0(drag, "coefficient", -1.0, import);
    spec.drag.area = at_least_0(drag, "area", -1.0, import);
    spec.drag.linear = at_least_0(drag, "linear", 0.0, import);
}

}  // namespace roboss::sdf_import
