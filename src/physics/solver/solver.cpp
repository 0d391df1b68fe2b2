// See solver.h.
#include "physics/solver/solver.h"

#include <algorithm>

#include "physics/solver/solve_plan.h"

namespace roboss {
namespace {

PartFacts facts_of(const IslandSolver::Problem& p) {
    const auto is_motor = [](const JointRow& row) { return row.motor != nullptr; };
    return {p.robots.size(), !p.rows.contacts.empty(), std::ranges::any_of(p.rows.joints, is_motor),
            p.position};
}

}  // namespace

/// The method that solved it; none: it did not.
std::optional<SolveMethod> IslandSolver::attempt(Attempt attempt, const newton::Plan& newton,
                                                 const Problem& p, std::vector<double>& v, Report& report) {
    Lockstep<double> alone;
    const auto where = [](bool solved, SolveMethod method) {
        return solved ? std::optional(method) : std::nullopt;
    };
    switch (attempt) {
        case Attempt::kNewton:
            plan_ = newton;
            return where(Newton::solve(p, alone, v, report), SolveMethod::kNewton);
        case Attempt::kSweeps:
            plan_ = kPilePlan;
            return solve_by_sweeps(p, v, report);
        case Attempt::kHardened:
            plan_ = newton;
            return where(harden(p, v, report), SolveMethod::kHardened);
        case Attempt::kActiveSet:
            return where(displace(p, v, report), SolveMethod::kActiveSet);
    }
    return {};
}

bool IslandSolver::solve_plainly(const Problem& p, std::vector<double>& v, SolveReport& report) {
    v_before_ = v, contacts_before_ = p.rows.contacts;
    Lockstep<double> alone;
    Report solved;
    plan_ = {};
    start(p, v);
    const bool balances = Newton::solve(p, alone, v, solved);
    report = {static_cast<int>(solved.iterations), solved.residual, SolveMethod::kNewton};
    if (balances && newton::meets_tolerances(p, solved.residual)) return true;
    v = v_before_, p.rows.contacts = contacts_before_;
    report.residual = 0;
    return false;
}

SolveReport IslandSolver::solve(const Problem& p, std::vector<double>& v) {
    constexpr double kUseless = 1e-2;  // of the residual
    const SolvePlan plan = plan_for(facts_of(p));
    Report report;
    start(p, v);
    keep_beginning(p, v);
    std::optional<SolveMethod> method;
    for (const Attempt next : plan.attempts) {
        if (next != plan.attempts.front()) return_to_beginning(p, v);
        if ((method = attempt(next, plan.newton, p, v, report))) break;
    }
    if (!method || !(report.residual <= kUseless)) {
        method = SolveMethod::kSweptFromRest;
        settle_for_sweeps(p, v);
        set_gradient(p);
        report.residual = imbalance(p);
    }
    return {static_cast<int>(report.iterations), report.residual, *method};
}

}  // namespace roboss
