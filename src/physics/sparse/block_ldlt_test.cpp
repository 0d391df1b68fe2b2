// The sparse factorisation against a dense one, for any number of threads and each instruction set.
#include "physics/sparse/block_ldlt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "core/thread_pool.h"
#include "physics/sparse/front_kernel.h"

namespace roboss {
namespace {

/// A random symmetric matrix of blocks, positive definite by its diagonal.
struct Sample : BlockLdlt::Source {
    std::vector<std::size_t> sizes, first;
    std::vector<std::pair<int, int>> links;
    std::vector<double> dense;
    BlockPattern pattern;

    std::size_t n() const { return first.back(); }
    double& at(std::size_t i, std::size_t j) { return dense[i * n() + j]; }
    double at(std::size_t i, std::size_t j) const { return dense[i * n() + j]; }

    void finish(std::mt19937& random) {
        first.assign(1, 0);
        for (const std::size_t size : sizes) first.push_back(first.back() + size);
        dense.assign(n() * n(), 0.0);
        std::uniform_real_distribution<double> entry(-1, 1);
        const auto fill = [&](std::size_t p, std::size_t q) {
            for (std::size_t i = first[p]; i < first[p + 1]; ++i)
                for (std::size_t j = first[q]; j < first[q + 1]; ++j) at(i, j) = at(j, i) = entry(random);
        };
        for (std::size_t p = 0; p < sizes.size(); ++p) fill(p, p);
        for (const auto& [a, b] : links) fill(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
        for (std::size_t i = 0; i < n(); ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < n(); ++j) sum += std::fabs(at(i, j));
            at(i, i) = sum + 0.1;
        }
        pattern.analyse(sizes.size(), links);
    }
    void add_rows(std::size_t position, BlockLdlt& matrix) const override {
        const std::size_t p = pattern.node(position);
        const auto add = [&](std::size_t q) {
            const BlockLdlt::Block to = matrix.block(position, pattern.position(q));
            for (std::size_t i = 0; i < sizes[p]; ++i)
                for (std::size_t j = p == q ? i : 0; j < sizes[q]; ++j)
                    to.at[i * to.stride + j] += at(first[p] + i, first[q] + j);
        };
        add(p);
        std::set<std::size_t> others;
        for (const auto& [a, b] : links) {
            if (static_cast<std::size_t>(a) == p) others.insert(static_cast<std::size_t>(b));
            if (static_cast<std::size_t>(b) == p) others.insert(static_cast<std::size_t>(a));
        }
        for (const std::size_t q : others)
            if (pattern.position(q) > position) add(q);
    }
    double residual(const std::vector<double>& x, const std::vector<double>& b) const {
        double worst = 0;
        for (std::size_t i = 0; i < n(); ++i) {
            double sum = -b[i];
            for (std::size_t j = 0; j < n(); ++j) sum += at(i, j) * x[j];
            worst = std::max(worst, std::fabs(sum));
        }
        return worst;
    }
};

Sample random_graph(std::size_t nodes, std::size_t links, unsigned seed) {
    std::mt19937 random(seed);
    Sample sample;
    for (std::size_t k = 0; k < nodes; ++k) sample.sizes.push_back(random() % 7);
    for (std::size_t k = 0; k < links; ++k) {
        const int a = static_cast<int>(random() % nodes), b = static_cast<int>(random() % nodes);
        if (a != b) sample.links.emplace_back(a, b);
    }
    sample.finish(random);
    return sample;
}

Sample grid(int side, std::size_t size) {
    std::mt19937 random(3);
    Sample sample;
    sample.sizes.assign(static_cast<std::size_t>(side * side), size);
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            if (i + 1 < side) sample.links.emplace_back(i * side + j, (i + 1) * side + j);
            if (j + 1 < side) sample.links.emplace_back(i * side + j + 1, i * side + j);
        }
    sample.finish(random);
    return sample;
}

std::vector<double> right_side(std::size_t n) {
    std::vector<double> b(n);
    for (std::size_t i = 0; i < n; ++i) b[i] = std::sin(1.0 + static_cast<double>(i));
    return b;
}

std::vector<double> solve(const Sample& sample, BlockLdlt& matrix, const Team& team) {
    matrix.lay_out(sample.pattern, sample.sizes);
    std::vector<double> x = right_side(sample.n());
    matrix.solve(sample, x, 0, team);
    return x;
}

TEST(BlockLdlt, SolvesRandomGraphs) {
    BlockLdlt matrix;  // one for all, as in a run
    for (unsigned seed = 0; seed < 30; ++seed) {
        const Sample sample = random_graph(2 + seed * 2, seed * 3, seed);
        const std::vector<double> x = solve(sample, matrix, {});
        EXPECT_LT(sample.residual(x, right_side(sample.n())), 1e-12) << seed;
    }
}

TEST(BlockLdlt, ThreadsChangeNoBit) {
    const Sample sample = grid(17, 6);
    BlockLdlt alone, shared;
    const std::vector<double> x = solve(sample, alone, {});
    EXPECT_LT(sample.residual(x, right_side(sample.n())), 1e-12);
    for (const unsigned threads : {2U, 3U, 2U}) {
        ThreadPool pool(threads);
        EXPECT_EQ(solve(sample, shared, Team(pool)), x) << threads;
    }
}

/// In a matrix of two nodes of `size` rows, row `copy` repeats row `row`: one of them has no impulse of its
/// own, and the rest is as without it.
void expect_implied_row_left_out(std::size_t size, std::size_t row, std::size_t copy, unsigned seed,
                                 double tolerance) {
    std::mt19937 random(seed);
    Sample sample;
    sample.sizes = {size, size};
    sample.links = {{0, 1}};
    sample.finish(random);
    const std::size_t n = sample.n();
    for (std::size_t k = 0; k < n; ++k) sample.at(copy, k) = sample.at(k, copy) = sample.at(row, k);
    sample.at(copy, copy) = sample.at(copy, row) = sample.at(row, copy) = sample.at(row, row);
    BlockLdlt matrix;
    matrix.lay_out(sample.pattern, sample.sizes);
    std::vector<double> b = right_side(n);
    b[copy] = b[row];
    std::vector<double> x = b;
    matrix.solve(sample, x, 1e-7, {});
    EXPECT_LT(sample.residual(x, b), tolerance);
    EXPECT_TRUE(x[row] == 0 || x[copy] == 0);
}

TEST(BlockLdlt, LeavesOutImpliedRows) {
    expect_implied_row_left_out(2, 2, 3, 5, 1e-12);
}

TEST(BlockLdlt, LeavesOutImpliedRowsInTheMiddleOfLargeFronts) {
    expect_implied_row_left_out(25, 4, 30, 6, 1e-11);
}

TEST(FrontKernel, EachInstructionSetHasTheSameBits) {
    std::vector<const FrontKernel*> kernels{any_front_kernel()};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        if (const FrontKernel* kernel = avx2_front_kernel()) kernels.push_back(kernel);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
        if (const FrontKernel* kernel = avx512_front_kernel()) kernels.push_back(kernel);
#endif
    std::mt19937 random(1);
    std::uniform_real_distribution<double> entry(-1, 1);
    constexpr std::size_t kStride = 48, kRows = 41;
    std::vector<double> start(kStride * kRows), factors(16 * kStride);
    for (double& x : start) x = entry(random);
    for (double& x : factors) x = entry(random);
    std::vector<double> first;
    double first_dot = 0;
    for (const FrontKernel* kernel : kernels) {
        std::vector<double> a = start;
        kernel->subtract(a.data(), kStride, 16, kRows, kStride, a.data(), factors.data(), 16);
        std::vector<double> panel = factors;
        kernel->eliminate(a.data(), kStride, 8, 11, 24, kStride, panel.data());
        a.insert(a.end(), panel.begin(), panel.end());
        const double dot = kernel->dot(a.data(), factors.data(), kStride);
        if (first.empty()) first = a, first_dot = dot;
        EXPECT_EQ(a, first);
        EXPECT_EQ(dot, first_dot);
    }
    double expected = start[20 * kStride + 30];
    for (std::size_t k = 0; k < 16; ++k) expected -= factors[k * kStride + 20] * start[k * kStride + 30];
    EXPECT_EQ(first[20 * kStride + 30], expected);
    expected = start[9 * kStride + 30] - factors[9] * start[8 * kStride + 30];  // the second of the panel
    EXPECT_EQ(first[9 * kStride + 30], expected);
    EXPECT_EQ(first[(kRows + 1) * kStride + 30], expected * start[9 * kStride + 9]);
}

}  // namespace
}  // namespace roboss
