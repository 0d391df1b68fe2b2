// Six numbers of a body in the registers of one instruction set: kWidth doubles each. Every name is local to
// the translation unit that includes this, so code for one processor is never linked in place of another's.
#pragma once

#include <cstddef>

#include "physics/bodies/body_island.h"

namespace roboss {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t kWidth = 8;
#elif defined(__AVX2__)
constexpr std::size_t kWidth = 4;
#else
constexpr std::size_t kWidth = 2;
#endif
constexpr std::size_t kParts = (6 + kWidth - 1) / kWidth;
using Part [[gnu::vector_size(kWidth * sizeof(double))]] = double;

/// Six numbers in one to three registers; members, not an array, so that they stay there.
struct Row {
    Part a{}, b{}, c{};
};

[[gnu::always_inline]] inline Part load_part(const double* x) {
    using Place [[gnu::may_alias]] = Part;
    return *reinterpret_cast<const Place*>(x);
}
[[gnu::always_inline]] inline void store_part(const Part& part, double* x) {
    using Place [[gnu::may_alias]] = Part;
    *reinterpret_cast<Place*>(x) = part;
}
[[gnu::always_inline]] inline Row load(const Six& six) {
    Row row;
    row.a = load_part(six.x);
    if constexpr (kParts > 1) row.b = load_part(six.x + kWidth);
    if constexpr (kParts > 2) row.c = load_part(six.x + 2 * kWidth);
    return row;
}
[[gnu::always_inline]] inline void store(const Row& row, Six& six) {
    store_part(row.a, six.x);
    if constexpr (kParts > 1) store_part(row.b, six.x + kWidth);
    if constexpr (kParts > 2) store_part(row.c, six.x + 2 * kWidth);
}
[[gnu::always_inline]] inline Part all(double x) {
    return x - Part{};
}
[[gnu::always_inline]] inline Row zero() {
    return {Part{}, Part{}, Part{}};
}
[[gnu::always_inline]] inline Row operator+(const Row& x, const Row& y) {
    Row sum;
    sum.a = x.a + y.a;
    if constexpr (kParts > 1) sum.b = x.b + y.b;
    if constexpr (kParts > 2) sum.c = x.c + y.c;
    return sum;
}
[[gnu::always_inline]] inline Row operator-(const Row& x, const Row& y) {
    Row difference;
    difference.a = x.a - y.a;
    if constexpr (kParts > 1) difference.b = x.b - y.b;
    if constexpr (kParts > 2) difference.c = x.c - y.c;
    return difference;
}
[[gnu::always_inline]] inline Row operator*(const Row& x, const Row& y) {
    Row product;
    product.a = x.a * y.a;
    if constexpr (kParts > 1) product.b = x.b * y.b;
    if constexpr (kParts > 2) product.c = x.c * y.c;
    return product;
}
[[gnu::always_inline]] inline Row operator*(double factor, const Row& x) {
    const Part f = all(factor);
    Row product;
    product.a = f * x.a;
    if constexpr (kParts > 1) product.b = f * x.b;
    if constexpr (kParts > 2) product.c = f * x.c;
    return product;
}
[[gnu::always_inline]] inline void add(Row& sum, double factor, const Row& x) {
    sum = sum + factor * x;
}
[[gnu::always_inline]] inline void subtract(Row& sum, double factor, const Row& x) {
    sum = sum - factor * x;
}
/// A template only so that the forms for other registers are not looked at.
template <class AnyRow>
[[gnu::always_inline]] inline double total(const AnyRow& x) {
    if constexpr (kParts == 1) return ((x.a[0] + x.a[1]) + (x.a[2] + x.a[3])) + (x.a[4] + x.a[5]);
    if constexpr (kParts == 2) return ((x.a[0] + x.a[1]) + (x.a[2] + x.a[3])) + (x.b[0] + x.b[1]);
    return ((x.a[0] + x.a[1]) + (x.b[0] + x.b[1])) + (x.c[0] + x.c[1]);
}
[[gnu::always_inline]] inline Row times(const SixBlock& block, const Six& x) {
    Row y = x.x[0] * load(block.row[0]);
    for (std::size_t i = 1; i < 6; ++i) add(y, x.x[i], load(block.row[i]));
    return y;
}

}  // namespace
}  // namespace roboss
