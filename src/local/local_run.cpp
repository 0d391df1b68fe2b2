// See local_run.h.
#include "local/local_run.h"

#include <algorithm>
#include <iterator>

#include "model/topics.h"

namespace roboss {

namespace {

Error not_finite(const Model& model, const StepOutcome& outcome) {
    const Robot& robot = model.robots[outcome.not_finite.index()];
    std::string what = "the state of robot '" + robot.name + "'";
    if (outcome.not_finite_joint.valid())
        what += " (joint '" +
                model.type_of(outcome.not_finite).joints[outcome.not_finite_joint.index()].name + "')";
    what += outcome.beyond_numbers ? " is beyond what can be computed" : " would not be finite";
    return {
        what + " after " + std::to_string(static_cast<double>(outcome.tick) * model.dt_s) + " s",
        "the world is intact at that time: look at it, at the last orders, or step with a smaller time step",
        "not-finite"};
}

}  // namespace

Result<std::unique_ptr<LocalRun>> LocalRun::create(std::shared_ptr<const Model> model,
                                                   const LocalRunOptions& options) {
    if (std::ranges::any_of(model->types, [](const RobotType& type) { return board_of(type) != nullptr; }))
        return Error{"the world has plugins that send or await messages (TriggeredPublisher and others)",
                     "run it with `roboss run`, or remove them", "message-board"};
    return std::unique_ptr<LocalRun>(new LocalRun(std::move(model), options));
}

LocalRun::LocalRun(std::shared_ptr<const Model> model, const LocalRunOptions& options)
    : RunAccess(std::move(model)),
      options_(options),
      stepper_(shared_model(), options.threads, options.lanes),
      seed_(options.seed) {
    states_.resize(shared_model()->robots.size());
    reset();
}

void LocalRun::reset(std::optional<std::uint64_t> seed) {
    seed_ = seed.value_or(seed_);
    tick_ = 0, given_ = 0;
    orders_.clear();
    for (std::size_t r = 0; r < states_.size(); ++r) states_[r] = initial_state(model(), RobotId(r));
    stepper_.forget();
    changed();
    forget_received();
}

Result<> LocalRun::step(Tick ticks) {
    if (ticks < 0)
        return Error{"a step of " + std::to_string(ticks) + " ticks", "give 0 or more", "bad-ticks"};
    const Tick until = tick_ + ticks;
    const auto due = std::ranges::lower_bound(orders_, until, {}, &Order::apply_at);
    const StepOutcome outcome = stepper_.step(tick_, until, {orders_.begin(), due}, states_);
    tick_ = outcome.tick;
    orders_.erase(orders_.begin(), std::ranges::lower_bound(orders_, tick_, {}, &Order::apply_at));
    changed();
    if (outcome.not_finite.valid()) return not_finite(model(), outcome);
    return Ok{};
}

Result<> LocalRun::order(RobotId robot, const Action& action) {
    Result<> done = submit({tick_, ClientId(0U), given_, robot, action});
    if (done) ++given_;
    return done;
}

Result<> LocalRun::order(std::vector<Order> orders) {
    std::uint64_t sequence = given_;
    for (Order& order : orders) {
        order.apply_at = tick_, order.client = ClientId(0U), order.sequence = sequence++;
        if (Result<> checked = check_order(model(), order); !checked) return checked;
    }
    given_ = sequence;
    const auto at =
        orders.empty() ? orders_.end() : std::ranges::upper_bound(orders_, orders.front(), comes_before);
    orders_.insert(at, std::make_move_iterator(orders.begin()), std::make_move_iterator(orders.end()));
    return Ok{};
}

Result<> LocalRun::change(RobotId robot, const Action& action) {
    const Order now{tick_, ClientId(0U), given_, robot, action};
    if (Result<> checked = check_order(model(), now); !checked) return checked;
    apply_order(model(), now, states_[robot.index()]);
    stepper_.forget();
    changed();
    return Ok{};
}

Result<> LocalRun::submit(const Order& order) {
    if (order.apply_at < tick_)
        return Error{"an order for tick " + std::to_string(order.apply_at) + ", but the world is at tick " +
                         std::to_string(tick_),
                     "give it earlier", "late"};
    if (Result<> checked = check_order(model(), order); !checked) return checked;
    orders_.insert(std::upper_bound(orders_.begin(), orders_.end(), order, comes_before), order);
    return Ok{};
}

LocalSave LocalRun::save() const {
    return {model().hash, seed_, tick_, states_, orders_, given_};
}

Result<> LocalRun::restore(const LocalSave& save) {
    if (save.model_hash != model().hash || save.states.size() != states_.size())
        return Error{"the state was saved with another world", "restore it in a run of the same world",
                     "other-world"};
    seed_ = save.seed, tick_ = save.tick, given_ = save.given;
    states_ = save.states;
    for (std::size_t r = 0; r < states_.size(); ++r)
        states_[r].own_type.move_to(model().type_of(RobotId(r)), states_[r].own);
    orders_ = save.orders;
    stepper_.forget();
    changed();
    forget_received();
    return Ok{};
}

Result<std::unique_ptr<LocalRun>> LocalRun::edited(const ModelEdit& edit) const {
    LocalRunOptions options = options_;
    options.seed = seed_;
    Result<std::unique_ptr<LocalRun>> made = create(edit.model, options);
    if (!made) return made;
    LocalRun& run = *made.value();
    std::ranges::move(carry_over(edit, states_), run.states_.begin());
    run.tick_ = tick_, run.given_ = given_;
    run.forget_received();
    run.orders_ = orders_;
    std::erase_if(run.orders_, [&](Order& order) { return !carry_over(edit, order); });
    return made;
}

}  // namespace roboss
