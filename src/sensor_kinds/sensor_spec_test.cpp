// parameters() and fields() name every member of a kind's parameters and readings: a member that one of them
// forgets would not be hashed, sent, imported or shown.
#include "sensor_kinds/sensor_spec.h"

#include <gtest/gtest.h>

#include <set>

namespace roboss {
namespace {

/// Initialises a member of any type.
struct Anything {
    template <class Member>
    operator Member() const;
};

/// Number of members of an aggregate: the most initialisers that it takes.
template <class Aggregate, class... Members>
constexpr std::size_t member_count() {
    if constexpr (requires { Aggregate{Members{}..., Anything{}}; })
        return member_count<Aggregate, Members..., Anything>();
    else
        return sizeof...(Members);
}

struct TwoMembers {
    int a;
    std::vector<double> b;
};
static_assert(member_count<TwoMembers>() == 2 && member_count<NoiseSpec>() == 5);

struct ParameterCounter {
    std::size_t count = 0;
    template <class Value>
    void operator()(const Parameter&, const Value&) {
        ++count;
    }
};

struct FieldCounter {
    std::size_t count = 0;
    template <class Value>
    void operator()(const ReadingField&, const Value&) {
        ++count;
    }
};

template <class Kind>
class OfEveryKind : public testing::Test {};

template <class Variant>
struct TypesOf;
template <class... Kinds>
struct TypesOf<std::variant<UnsupportedSensor, Kinds...>> {
    using Type = testing::Types<Kinds...>;
};
TYPED_TEST_SUITE(OfEveryKind, TypesOf<SensorParameters>::Type);

TEST(SensorKinds, HaveNumbersOfTheirOwn) {
    std::set<std::uint32_t> numbers;
    (void)parameters_of_kind([&](const SensorKind& kind) {
        EXPECT_TRUE(numbers.insert(kind.number).second) << kind.name;
        return false;
    });
}

TYPED_TEST(OfEveryKind, EveryParameterIsListed) {
    const TypeParam parameters;
    ParameterCounter counter;
    TypeParam::parameters(counter, parameters);
    EXPECT_EQ(counter.count, member_count<TypeParam>())
        << TypeParam::kKind.name << ": parameters() must visit every member";
}

TYPED_TEST(OfEveryKind, EveryFieldOfTheReadingIsListed) {
    using Reading = typename TypeParam::Reading;
    const Reading reading;
    FieldCounter counter;
    Reading::fields(counter, reading);
    EXPECT_EQ(counter.count + 1, member_count<Reading>())  // the tick is none of its fields
        << TypeParam::kKind.name << ": fields() must visit every member but `tick`";
}

}  // namespace
}  // namespace roboss
