// Every element of SDFormat 1.9 to 1.11 that says something about motion: it either changes the Model, or a
// diagnostic names it, with file and line. Nothing is dropped without a word.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "model/model.h"
#include "sdf/load_world.h"

namespace roboss {
namespace {

/// Where an element stands in the world below.
enum class In {
    kWorld,
    kPhysics,
    kModel,
    kLink,
    kInertial,
    kCollision,
    kSurface,
    kRevolute,
    kRevoluteAxis,
    kContinuousAxis,
    kPrismaticAxis,
    kUniversalAxis2,
    kBall,
    kScrew,
    kGearbox,
    kGearboxAxis2,
    kSensor
};

struct Element {
    In in;
    const char* text;
    const char* named = "";  // in the diagnostic; empty: it must have an effect
    const char* version = "1.9";
};

/// SDFormat's joints, links and surfaces. `at` is replaced by `text`, on a line of its own.
std::string world_with(In at, const std::string& text, const std::string& version) {
    const auto slot = [&](In in) { return in == at ? "\n" + text + "\n" : std::string(); };
    const std::string mass = "<mass>2</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia>";
    const auto link = [&](const std::string& name, const std::string& inner) {
        return "<link name='" + name + "'><inertial>" + mass + "</inertial>" + inner + "</link>";
    };
    const std::string axis = "<xyz>0 0 1</xyz>";
    const auto joint = [&](const std::string& type, const std::string& child, const std::string& inner) {
        return "<joint name='" + type + "' type='" + type + "'><parent>base</parent><child>" + child +
               "</child>" + inner + "</joint>";
    };
    const std::string shape = "<collision name='c'><geometry><box><size>.2 .2 .2</size></box></geometry>" +
                              slot(In::kCollision) + "<surface>" + slot(In::kSurface) +
                              "</surface></collision>";
    const std::string sensor =
        "<sensor name='laser' type='lidar'><lidar><scan><horizontal><samples>3</samples>"
        "<min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan><range><min>.1"
        "</min><max>9</max></range></lidar>" +
        slot(In::kSensor) + "</sensor>";
    return "<sdf version='" + version + "' xmlns:roboss='urn:roboss:1'><world name='w'>" + slot(In::kWorld) +
           "<physics name='p' type='ode'><max_step_size>.001</max_step_size>" + slot(In::kPhysics) +
           "</physics><model name='m'>" + slot(In::kModel) + "<link name='base'><inertial>" + mass +
           slot(In::kInertial) + "</inertial>" + shape + sensor + slot(In::kLink) + "</link>" +
           link("a", "") + link("b", "") + link("c", "") + link("d", "") + link("e", "") + link("f", "") +
           joint("revolute", "a",
                 slot(In::kRevolute) + "<axis>" + axis + slot(In::kRevoluteAxis) + "</axis>") +
           joint("prismatic", "b", "<axis>" + axis + slot(In::kPrismaticAxis) + "</axis>") +
           joint(
               "universal", "c",
               "<axis>" + axis + "</axis><axis2><xyz>0 1 0</xyz>" + slot(In::kUniversalAxis2) + "</axis2>") +
           joint("ball", "d", slot(In::kBall)) +
           joint("screw", "e", "<axis>" + axis + "</axis>" + slot(In::kScrew)) +
           joint("continuous", "f", "<axis>" + axis + slot(In::kContinuousAxis) + "</axis>") +
           "<joint name='gears' type='gearbox'><parent>a</parent><child>f</child><gearbox_reference_body>base"
           "</gearbox_reference_body><axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 1</xyz>" +
           slot(In::kGearboxAxis2) + "</axis2>" + slot(In::kGearbox) + "</joint></model></world></sdf>\n";
}

struct Outcome {
    std::uint64_t hash = 0;
    std::vector<Diagnostic> diagnostics;
};

Outcome load(const std::string& text) {
    std::string file = (std::filesystem::temp_directory_path() / "roboss-elements-XXXXXX").string();
    const int handle = mkstemp(file.data());
    if (handle >= 0) close(handle);
    std::ofstream(file) << text;
    Outcome outcome;
    Diagnostics diagnostics;
    const std::optional<World> world = load_world(file, {}, diagnostics);
    std::filesystem::remove(file);
    if (world && !diagnostics.has_errors()) {
        const auto model = compile(*world, {}, diagnostics);
        if (model) outcome.hash = model->hash;
    }
    outcome.diagnostics = diagnostics.items();
    return outcome;
}

const Element kElements[] = {
    // axes
    {In::kRevoluteAxis, "<limit><lower>-1</lower></limit>"},
    {In::kRevoluteAxis, "<limit><upper>1</upper></limit>"},
    {In::kRevoluteAxis, "<limit><effort>3</effort></limit>"},
    {In::kRevoluteAxis, "<limit><velocity>3</velocity></limit>"},
    {In::kRevoluteAxis, "<limit><upper>1</upper><stiffness>100</stiffness></limit>"},
    {In::kRevoluteAxis,
     "<limit><upper>1</upper><stiffness>100</stiffness><dissipation>7</dissipation></limit>"},
    {In::kRevoluteAxis, "<limit><upper>1</upper><dissipation>7</dissipation></limit>", "dissipation"},
    {In::kRevoluteAxis, "<limit><stiffness>100</stiffness></limit>", "<stiffness>"},
    {In::kRevoluteAxis, "<limit><dissipation>7</dissipation></limit>", "<dissipation>"},
    {In::kRevoluteAxis, "<roboss:motor><position_gain>9</position_gain></roboss:motor>"},
    {In::kRevoluteAxis, "<roboss:motor><gain>9</gain></roboss:motor>", "<gain>"},
    {In::kContinuousAxis, "<limit><effort>3</effort></limit>"},
    {In::kContinuousAxis, "<limit><lower>-1</lower></limit>", "<lower>"},
    {In::kContinuousAxis, "<limit><upper>1</upper></limit>", "<upper>"},
    {In::kContinuousAxis, "<limit><stiffness>100</stiffness></limit>", "<stiffness>"},
    {In::kRevoluteAxis, "<dynamics><damping>.1</damping></dynamics>"},
    {In::kRevoluteAxis, "<dynamics><friction>.1</friction></dynamics>"},
    {In::kRevoluteAxis, "<dynamics><spring_stiffness>4</spring_stiffness></dynamics>"},
    {In::kRevoluteAxis, "<dynamics><spring_reference>.2</spring_reference></dynamics>", "spring_reference"},
    {In::kRevoluteAxis,
     "<dynamics><spring_stiffness>4</spring_stiffness><spring_reference>.2</spring_reference></dynamics>"},
    {In::kRevoluteAxis, "<initial_position>.3</initial_position>", "", "1.5"},
    {In::kRevoluteAxis, "<mimic joint='prismatic'><multiplier>2</multiplier></mimic>", "", "1.11"},
    {In::kRevoluteAxis, "<mimic joint='prismatic'><multiplier>2</multiplier><offset>.1</offset></mimic>", "",
     "1.11"},
    {In::kPrismaticAxis, "<dynamics><damping>.1</damping></dynamics>"},
    {In::kPrismaticAxis, "<limit><upper>1</upper></limit>"},
    {In::kUniversalAxis2, "<dynamics><damping>.1</damping></dynamics>"},
    {In::kUniversalAxis2, "<limit><lower>-1</lower><upper>1</upper></limit>"},
    {In::kUniversalAxis2, "<limit><effort>3</effort></limit>"},
    // joints
    {In::kRevolute, "<axis2><xyz>0 1 0</xyz><dynamics><damping>.1</damping></dynamics></axis2>", "axis2"},
    {In::kRevolute, "<axis2><xyz>0 1 0</xyz><limit><effort>3</effort></limit></axis2>", "axis2"},
    {In::kRevolute, "<axis2><xyz>0 1 0</xyz><initial_position>.1</initial_position></axis2>", "axis2"},
    {In::kRevolute, "<thread_pitch>2</thread_pitch>", "thread_pitch"},
    {In::kRevolute, "<gearbox_ratio>2</gearbox_ratio>", "gearbox_ratio"},
    {In::kRevolute, "<gearbox_reference_body>base</gearbox_reference_body>", "gearbox_reference_body"},
    {In::kRevolute, "<physics><ode><cfm>.1</cfm></ode></physics>", "<physics>"},
    {In::kRevolute, "<physics><ode><erp>.1</erp></ode></physics>", "<physics>"},
    {In::kRevolute, "<physics><ode><cfm_damping>1</cfm_damping></ode></physics>", "<physics>"},
    {In::kRevolute, "<physics><ode><implicit_spring_damper>1</implicit_spring_damper></ode></physics>",
     "<physics>"},
    {In::kRevolute, "<physics><ode><fudge_factor>.1</fudge_factor></ode></physics>", "<physics>"},
    {In::kRevolute, "<physics><ode><bounce>.1</bounce></ode></physics>", "<physics>"},
    {In::kRevolute, "<physics><ode><max_force>.1</max_force></ode></physics>", "<physics>"},
    {In::kRevolute, "<physics><ode><velocity>.1</velocity></ode></physics>", "<physics>"},
    {In::kRevolute, "<physics><ode><limit><cfm>.1</cfm><erp>.3</erp></limit></ode></physics>", "<physics>"},
    {In::kRevolute, "<physics><ode><suspension><cfm>.1</cfm><erp>.3</erp></suspension></ode></physics>",
     "<physics>"},
    {In::kRevolute, "<physics><simbody><must_be_loop_joint>1</must_be_loop_joint></simbody></physics>",
     "<physics>"},
    {In::kRevolute, "<physics><provide_feedback>1</provide_feedback></physics>", "<physics>"},
    {In::kRevolute, "<sensor name='ft' type='force_torque'/>"},
    {In::kRevolute, "<sensor name='i' type='imu'/>", "imu"},
    {In::kRevolute, "<pose>0 0 .1 0 0 0</pose>"},
    {In::kBall, "<axis><xyz>0 0 1</xyz><dynamics><damping>.1</damping></dynamics></axis>"},
    {In::kBall, "<axis><xyz>0 0 1</xyz><dynamics><friction>.1</friction></dynamics></axis>", "axis"},
    {In::kBall, "<axis><xyz>0 0 1</xyz><limit><effort>1</effort></limit></axis>", "axis"},
    {In::kBall, "<roboss:motor><position_gain>9</position_gain></roboss:motor>", "<roboss:motor>"},
    {In::kScrew, "<thread_pitch>2</thread_pitch>"},
    {In::kScrew, "<screw_thread_pitch>.01</screw_thread_pitch>", "", "1.10"},
    {In::kGearbox, "<gearbox_ratio>2</gearbox_ratio>"},
    {In::kGearbox, "<dynamics/>", "dynamics"},
    {In::kGearbox, "<roboss:motor><position_gain>9</position_gain></roboss:motor>", "gearbox"},
    {In::kGearboxAxis2, "<limit><effort>3</effort></limit>", "gearbox"},
    {In::kGearboxAxis2, "<limit><velocity>3</velocity></limit>", "gearbox"},
    {In::kGearboxAxis2, "<initial_position>.1</initial_position>", "gearbox", "1.5"},
    {In::kGearboxAxis2, "<mimic joint='prismatic'><multiplier>2</multiplier></mimic>", "gearbox", "1.11"},
    // surfaces
    {In::kCollision, "<max_contacts>2</max_contacts>"},
    {In::kCollision, "<laser_retro>9</laser_retro>"},
    {In::kSurface, "<friction><ode><mu>.3</mu></ode></friction>"},
    {In::kSurface, "<friction><ode><mu2>.3</mu2></ode></friction>", "<mu2>"},
    {In::kSurface, "<friction><ode><mu2>.3</mu2><fdir1>1 0 0</fdir1></ode></friction>"},
    {In::kSurface, "<friction><ode><slip1>.3</slip1></ode></friction>", "slip1"},
    {In::kSurface, "<friction><ode><slip2>.3</slip2></ode></friction>", "slip2"},
    {In::kSurface, "<friction><bullet><friction>.3</friction></bullet></friction>", "<bullet>"},
    {In::kSurface, "<friction><bullet><friction2>.3</friction2></bullet></friction>", "<bullet>"},
    {In::kSurface, "<friction><bullet><fdir1>1 0 0</fdir1></bullet></friction>", "<bullet>"},
    {In::kSurface, "<friction><bullet><rolling_friction>.3</rolling_friction></bullet></friction>",
     "<bullet>"},
    {In::kSurface,
     "<friction><ode><mu>.3</mu></ode><bullet><rolling_friction>.3</rolling_friction></bullet></friction>",
     "<bullet>"},
    {In::kSurface, "<friction><torsional><coefficient>.3</coefficient></torsional></friction>"},
    {In::kSurface, "<friction><torsional><patch_radius>.3</patch_radius></torsional></friction>"},
    {In::kSurface,
     "<friction><torsional><use_patch_radius>0</use_patch_radius><surface_radius>.3</surface_radius></"
     "torsional></friction>"},
    {In::kSurface, "<friction><torsional><surface_radius>.3</surface_radius></torsional></friction>",
     "surface_radius"},
    {In::kSurface, "<friction><torsional><ode><slip>.3</slip></ode></torsional></friction>", "slip"},
    {In::kSurface, "<bounce><restitution_coefficient>.3</restitution_coefficient></bounce>"},
    {In::kSurface, "<bounce><threshold>.3</threshold></bounce>"},
    {In::kSurface, "<contact><collide_bitmask>3</collide_bitmask></contact>"},
    {In::kSurface, "<contact><category_bitmask>3</category_bitmask></contact>"},
    {In::kSurface, "<contact><collide_without_contact>1</collide_without_contact></contact>",
     "collide_without_contact"},
    {In::kSurface, "<contact><collide_without_contact_bitmask>3</collide_without_contact_bitmask></contact>",
     "collide_without_contact_bitmask"},
    {In::kSurface, "<contact><poissons_ratio>.1</poissons_ratio></contact>", "poissons_ratio"},
    {In::kSurface, "<contact><elastic_modulus>1e6</elastic_modulus></contact>", "elastic_modulus"},
    {In::kSurface, "<contact><ode><kp>1e5</kp></ode></contact>"},
    {In::kSurface, "<contact><ode><kp>1e5</kp><kd>9</kd></ode></contact>"},
    {In::kSurface, "<contact><ode><kd>9</kd></ode></contact>", "kd"},
    {In::kSurface, "<contact><ode><soft_cfm>.1</soft_cfm></ode></contact>"},
    {In::kSurface, "<contact><ode><soft_erp>.1</soft_erp></ode></contact>", "soft_erp"},
    {In::kSurface, "<contact><ode><max_vel>.1</max_vel></ode></contact>"},
    {In::kSurface, "<contact><ode><min_depth>.01</min_depth></ode></contact>"},
    {In::kSurface, "<contact><bullet><kp>1e5</kp></bullet></contact>", "bullet"},
    {In::kSurface, "<contact><bullet><split_impulse>0</split_impulse></bullet></contact>", "bullet"},
    {In::kSurface, "<soft_contact><dart><stiffness>3</stiffness></dart></soft_contact>", "soft_contact"},
    {In::kSurface, "<roboss:rolling_friction>.001</roboss:rolling_friction>"},
    // links and models
    {In::kLink, "<gravity>0</gravity>"},
    {In::kLink, "<kinematic>1</kinematic>", "kinematic"},
    {In::kLink, "<enable_wind>1</enable_wind>"},
    {In::kLink, "<self_collide>1</self_collide>"},
    {In::kLink, "<self_collide>1</self_collide>", "self_collide"},
    {In::kLink, "<roboss:drag><linaer>1</linaer></roboss:drag>", "<linaer>"},
    {In::kLink, "<velocity_decay><linear>.1</linear></velocity_decay>", "velocity_decay"},
    {In::kLink, "<velocity_decay><angular>.1</angular></velocity_decay>", "velocity_decay"},
    {In::kLink, "<must_be_base_link>1</must_be_base_link>", "must_be_base_link"},
    {In::kLink, "<battery name='b'><voltage>12</voltage></battery>", "battery"},
    {In::kLink, "<roboss:radio name='r'><channel>3</channel></roboss:radio>"},
    {In::kLink, "<sensor name='i' type='imu'/>"},
    {In::kLink, "<sensor name='a' type='altimeter'/>"},
    {In::kLink, "<sensor name='a' type='air_speed'/>"},
    {In::kLink, "<sensor name='a' type='air_pressure'/>"},
    {In::kLink,
     "<sensor name='l' "
     "type='logical_camera'><logical_camera><near>0</near><far>5</far></logical_camera></sensor>"},
    {In::kLink, "<sensor name='a' type='sonar'><sonar><min>0</min><max>2</max></sonar></sensor>"},
    {In::kLink, "<sensor name='a' type='wireless_receiver'/>", "wireless_receiver"},
    {In::kInertial, "<pose>0 0 .1 0 0 0</pose>"},
    {In::kInertial, "<fluid_added_mass><xx>1</xx></fluid_added_mass>", "", "1.10"},
    {In::kModel, "<self_collide>1</self_collide>"},
    {In::kModel, "<enable_wind>1</enable_wind>"},
    {In::kModel, "<allow_auto_disable>0</allow_auto_disable>"},
    {In::kModel, "<static>1</static>"},
    {In::kModel, "<gripper name='g'><gripper_link>a</gripper_link><palm_link>base</palm_link></gripper>",
     "gripper"},
    // world
    {In::kWorld, "<gravity>0 0 -1</gravity>"},
    {In::kWorld, "<magnetic_field>1 0 0</magnetic_field>"},
    {In::kWorld, "<wind><linear_velocity>1 0 0</linear_velocity></wind>"},
    {In::kWorld, "<atmosphere type='adiabatic'><pressure>9e4</pressure></atmosphere>"},
    {In::kWorld, "<atmosphere type='adiabatic'><temperature_gradient>-.1</temperature_gradient></atmosphere>",
     "temperature_gradient"},
    {In::kWorld, "<population name='p'/>", "population"},
    {In::kWorld, "<state world_name='w'/>", "state"},
    {In::kWorld, "<actor name='a'/>", "actor"},
    {In::kWorld, "<wind><speed>1</speed></wind>", "<speed>"},
    {In::kWorld, "<spherical_coordinates><latitude>1</latitude></spherical_coordinates>", "<latitude>"},
    {In::kPhysics, "<max_contacts>2</max_contacts>"},
    {In::kPhysics, "<gravity>0 0 -1</gravity>", "", "1.4"},
    {In::kPhysics, "<magnetic_field>1 0 0</magnetic_field>", "", "1.5"},
    {In::kPhysics, "<step_size>.002</step_size>", "<step_size>"},
    {In::kPhysics, "<ode><solver><iters>9</iters></solver></ode>", "<ode>"},
    {In::kPhysics, "<bullet><solver><iters>9</iters></solver></bullet>", "<bullet>"},
    {In::kPhysics, "<dart><collision_detector>ode</collision_detector></dart>", "<dart>"},
    {In::kPhysics, "<simbody><accuracy>.1</accuracy></simbody>", "<simbody>"},
    // sensors
    {In::kSensor, "<update_rate>10</update_rate>"},
    {In::kSensor, "<pose>0 0 .1 0 0 0</pose>"},
};

int line_of(const std::string& text, const std::string& part) {
    return 1 + static_cast<int>(std::count(
                   text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(part)), '\n'));
}

TEST(SdfElements, EachHasItsEffectOrADiagnosticWithItsLine) {
    std::map<std::string, Outcome> bases;
    for (const Element& element : kElements) {
        const auto [known, is_new] = bases.try_emplace(element.version);
        if (is_new) known->second = load(world_with(In::kWorld, "", element.version));
        const Outcome& base = known->second;
        const std::string text = world_with(element.in, element.text, element.version);
        const Outcome with = load(text);
        ASSERT_NE(base.hash, 0u) << (base.diagnostics.empty() ? "" : to_text(base.diagnostics[0]));
        std::string reported;
        bool named = false;
        for (const Diagnostic& d : with.diagnostics) {
            reported += to_text(d) + "\n";
            // a block is reported at its own line or at that of the element that holds it, one line above
            const int line = line_of(text, element.text);
            named |= *element.named != '\0' && to_text(d).find(element.named) != std::string::npos &&
                     (d.where.line == line || d.where.line == line - 1);
        }
        const bool effect = with.hash != 0 && with.hash != base.hash;
        EXPECT_TRUE(*element.named == '\0' ? effect : named)
            << element.text << " (SDFormat " << element.version
            << "): " << (effect ? "has an effect" : "has no effect") << "\n"
            << reported;
    }
}

}  // namespace
}  // namespace roboss
