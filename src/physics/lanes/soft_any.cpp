// The soft solver on any processor, and the choice of the best kernel.
#include "physics/lanes/best_kernel.h"
#include "physics/lanes/lane_soft.h"

namespace roboss::soft {
namespace {

std::unique_ptr<Kernel> none() {
    return nullptr;
}

}  // namespace

Kernel::~Kernel() = default;

std::unique_ptr<Kernel> make_any_kernel() {
    return std::make_unique<LaneSoft>();
}

const Kernel& kernel(int patches) {
    static const std::unique_ptr<Kernel> two = make_any_kernel(),
                                         four = best_kernel(&none, make_avx2_kernel, make_any_kernel),
                                         eight = best_kernel(make_avx512_kernel, make_avx2_kernel,
                                                             make_any_kernel);
    return patches > 4 ? *eight : patches > 2 ? *four : *two;
}

}  // namespace roboss::soft
