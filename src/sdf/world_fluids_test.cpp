// Plugins of the world: fluids and wind, and which links float.
#include <gtest/gtest.h>

#include "sdf/test_files.h"

namespace roboss::sdf_test {
namespace {

std::string ball(const std::string& name, const std::string& link_name = "body") {
    return "<model name='" + name + "'>" +
           link(link_name,
                "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>") +
           "</model>";
}

std::string buoyancy(const std::string& inner) {
    return "<plugin filename='gz-sim-buoyancy-system' name='gz::sim::systems::Buoyancy'>" + inner +
           "</plugin>";
}

const std::string kLayers =
    "<graded_buoyancy><default_density>1000</default_density>"
    "<density_change><above_depth>0</above_depth><density>1</density></density_change>"
    "<density_change><above_depth>-2</above_depth><density>900</density></density_change></graded_buoyancy>";

TEST(WorldFluids, AUniformFluidCarriesEverything) {
    const Loaded loaded =
        load_elements(buoyancy("<uniform_fluid_density>1025</uniform_fluid_density>") + ball("a"));
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_TRUE(loaded.world->buoyancy);
    EXPECT_EQ(FluidLayers::of(*loaded.world->buoyancy).densities, std::vector<double>{1025});
    EXPECT_TRUE(loaded.world->prototypes[0].links[0].buoyant);
    EXPECT_EQ(loaded.world->extensions[0].fate, PluginFate::kRuns);
}

TEST(WorldFluids, LayersAreSortedByHeight) {
    const Loaded loaded = load_elements(buoyancy(kLayers) + ball("a"));
    ASSERT_TRUE(loaded.world && loaded.world->buoyancy) << loaded.text();
    const FluidLayers fluid = FluidLayers::of(*loaded.world->buoyancy);
    EXPECT_EQ(fluid.heights, (std::vector<double>{-2, 0}));
    EXPECT_EQ(fluid.densities, (std::vector<double>{1000, 900, 1}));
}

TEST(WorldFluids, OnlyEnabledModelsAndLinksFloat) {
    const Loaded loaded = load_elements(
        buoyancy("<enable>b</enable><enable>d::keel</enable>") + ball("a") + ball("b") + ball("c") +
        "<model name='d'>" +
        link("keel",
             "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>") +
        link("mast",
             "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>") +
        "<joint name='j' type='fixed'><parent>keel</parent><child>mast</child></joint></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    const auto floats = [&](const std::string& name, std::size_t l) {
        for (const ModelInstance& instance : loaded.world->instances)
            if (instance.name == name) return loaded.world->prototypes[instance.prototype].links[l].buoyant;
        ADD_FAILURE() << name;
        return false;
    };
    EXPECT_FALSE(floats("a", 0));
    EXPECT_TRUE(floats("b", 0));
    EXPECT_FALSE(floats("c", 0));
    EXPECT_TRUE(floats("d", 0));
    EXPECT_FALSE(floats("d", 1));
}

TEST(WorldFluids, BadDensitiesAreReportedAndNothingFloats) {
    const Loaded loaded =
        load_elements(buoyancy("<uniform_fluid_density>-3</uniform_fluid_density>") + ball("a"));
    ASSERT_TRUE(loaded.world) << loaded.text();
    EXPECT_FALSE(loaded.world->buoyancy);
    EXPECT_NE(loaded.find("plugin-not-run"), nullptr);
    EXPECT_EQ(loaded.world->extensions[0].fate, PluginFate::kNotRun);
}

TEST(WorldFluids, WindEffectsAreRead) {
    const Loaded loaded = load_elements(
        "<plugin filename='libignition-gazebo-wind-effects-system.so' "
        "name='ignition::gazebo::systems::WindEffects'>"
        "<force_approximation_scaling_factor>0.5</force_approximation_scaling_factor>"
        "<horizontal><magnitude><time_for_rise>10</time_for_rise><sin><period>60</period></sin>"
        "<noise type='gaussian'><stddev>0.2</stddev></noise></magnitude></horizontal></plugin>" +
        ball("a"));
    ASSERT_TRUE(loaded.world && loaded.world->wind_effects) << loaded.text();
    EXPECT_EQ(loaded.world->wind_effects->scale, 0.5);
    EXPECT_EQ(loaded.world->wind_effects->magnitude_rise, 10);
    EXPECT_EQ(loaded.world->wind_effects->magnitude_period, 60);
    EXPECT_EQ(loaded.world->wind_effects->magnitude_noise_deviation, 0.2);
    EXPECT_EQ(loaded.world->wind_effects->vertical_rise, 1);
}

Loaded load_factor(const std::string& factor) {
    return load_elements(
        "<plugin filename='gz-sim-wind-effects-system' name='gz::sim::systems::WindEffects'>"
        "<force_approximation_scaling_factor>" +
        factor + "</force_approximation_scaling_factor></plugin>" + ball("a"));
}

/// The factor at a place.
double factor_at(const WindEffectsSpec& wind, const Vec3& p) {
    for (const WindRegion& region : wind.regions)
        if (region.holds(p)) return region.factor(p);
    return 0;
}

TEST(WorldFluids, AFactorDependsOnThePlace) {
    const Loaded loaded = load_factor(
        "<when zgt='0' zlt='5'>0.2</when><when zge='5'><k>0.5</k><px>1 0.01 0 0</px><qy>0 0.01 2 0</qy>"
        "<rz>0 0 0.01 0.45</rz></when>");
    ASSERT_TRUE(loaded.world && loaded.world->wind_effects) << loaded.text();
    EXPECT_EQ(loaded.diagnostics.items().size(), 0u) << loaded.text();
    const WindEffectsSpec& wind = *loaded.world->wind_effects;
    EXPECT_EQ(factor_at(wind, {3, 4, 0}), 0);
    EXPECT_EQ(factor_at(wind, {3, 4, 1e-9}), 0.2);
    EXPECT_EQ(factor_at(wind, {3, 4, 4.999999}), 0.2);
    EXPECT_NEAR(factor_at(wind, {3, 4, 5}), 0.5 * (27 + 0.09 + 0.16 + 8 + 0.05 + 0.45), 1e-12);
    EXPECT_EQ(factor_at(wind, {-30, 4, 5}), 0) << "a negative factor would feed the motion";
}

TEST(WorldFluids, AFactorMayBeOnePolynomialForAllSpace) {
    const Loaded loaded = load_factor("<k>2</k><px>0 0 0 1</px><rz>0 1 0 0</rz>");
    ASSERT_TRUE(loaded.world && loaded.world->wind_effects) << loaded.text();
    EXPECT_EQ(factor_at(*loaded.world->wind_effects, {-1e9, 0, -3}), 2 * (1 + 9));
}

TEST(WorldFluids, AFactorThatCannotBeReadIsReported) {
    for (const char* bad : {"<when zge='five'>1</when>", "<when zge='0'>much</when>", "<px>1 2 3</px>"}) {
        const Loaded loaded = load_factor(bad);
        ASSERT_TRUE(loaded.world) << loaded.text();
        EXPECT_FALSE(loaded.world->wind_effects) << bad;
        EXPECT_NE(loaded.find("plugin-not-run"), nullptr) << loaded.text();
    }
}

TEST(WorldFluids, HydrodynamicsHasItsMatrices) {
    const Loaded loaded =
        load_elements("<model name='a'>" + link("hull") +
                      "<plugin filename='gz-sim-hydrodynamics-system' name='gz::sim::systems::Hydrodynamics'>"
                      "<link_name>hull</link_name><xU>-3</xU><yVabsV>-4</yVabsV><zWW>-5</zWW><nDotR>-6</"
                      "nDotR><mUabsQ>7</mUabsQ>"
                      "<waterDensity>1000</waterDensity></plugin></model>");
    ASSERT_TRUE(loaded.world) << loaded.text();
    ASSERT_EQ(loaded.world->prototypes[0].onboard.size(), 1u) << loaded.text();
    const auto& spec = std::get<HydrodynamicsSpec>(loaded.world->prototypes[0].onboard[0].parameters);
    EXPECT_EQ(spec.linear[0], -3);
    EXPECT_EQ(spec.absolute[36 * 1 + 6 * 1 + 1], -4);
    EXPECT_EQ(spec.square[36 * 2 + 6 * 2 + 2], -5);
    EXPECT_EQ(spec.added_mass[35], -6);
    EXPECT_EQ(spec.absolute[36 * 4 + 6 * 0 + 4], 7);
    EXPECT_NE(loaded.find("ignored-element"), nullptr);
}

TEST(WorldFluids, AddedMassOfALinkIsRead) {
    const auto loaded_with = [](const std::string& numbers) {
        return load_elements(
            "<model name='a'><link name='l'><inertial><mass>2</mass><inertia><ixx>1</ixx>"
            "<iyy>1</iyy><izz>1</izz></inertia><fluid_added_mass>" +
                numbers + "</fluid_added_mass></inertial></link></model>",
            "1.10");
    };
    const Loaded good = loaded_with("<xx>3</xx><yr>0.5</yr><yy>4</yy><rr>2</rr>");
    ASSERT_TRUE(good.world) << good.text();
    const std::vector<double>& A = good.world->prototypes[0].links[0].added_mass;
    ASSERT_EQ(A.size(), kAddedMassNumbers) << good.text();
    EXPECT_EQ(A[0], 3);
    EXPECT_EQ(A[6], 4);
    EXPECT_EQ(A[10], 0.5);
    EXPECT_EQ(A[20], 2);
    const Loaded bad = loaded_with("<xx>-3</xx>");
    ASSERT_TRUE(bad.world) << bad.text();
    EXPECT_TRUE(bad.world->prototypes[0].links[0].added_mass.empty());
    EXPECT_NE(bad.find("added-mass"), nullptr);
}

}  // namespace
}  // namespace roboss::sdf_test
