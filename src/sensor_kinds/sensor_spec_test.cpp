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
static_assert(member_count<TwoMembers>() == 2 && member_count<NoiseSpec>() == 7);

/// Members, not elements: two elements may stand for one member.
struct ParameterCounter {
    std::set<const void*> members;
    template <class Value>
    void operator()(const Parameter&, const Value& value) {
        members.insert(&value);
    }
};

/// Members of a kind; those of a camera's optics in place of the optics.
template <class Kind>
constexpr std::size_t parameter_count() {
    if constexpr (requires(Kind kind) { kind.optics; })
        return member_count<Kind>() - 1 + member_count<CameraOptics>();
    else
        return member_count<Kind>();
}

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
    EXPECT_EQ(counter.members.size(), parameter_count<TypeParam>())
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
