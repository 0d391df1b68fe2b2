// See live_array.h.
#include "live_array.h"

namespace nb = nanobind;

namespace roboss_python {

void LiveArray::update(std::size_t part, const roboss::RunAccess& run) {
    if (versions_[part] == run.version()) return;
    const std::size_t size = numbers_.size() / versions_.size();
    ((*set_).*read_)(run, std::span(numbers_).subspan(part * size, size));
    versions_[part] = run.version();
}

LiveArray::Array LiveArray::array(const std::shared_ptr<LiveArray>& self, bool is_single) {
    const nb::capsule owner(new Holder(self), [](void* p) noexcept { delete static_cast<Holder*>(p); });
    const std::size_t shape[3] = {self->versions_.size(), self->set_->size(), self->columns_};
    return {self->numbers_.data(), is_single ? 2U : 3U, shape + (is_single ? 1 : 0), owner};
}

}  // namespace roboss_python
