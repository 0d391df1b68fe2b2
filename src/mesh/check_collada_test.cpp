// COLLADA files that ended the process inside assimp 5.2: each is an Error that names the line.
#include "mesh/check_collada.h"

#include <gtest/gtest.h>

#include <support/folder.h>

#include "mesh/mesh_file.h"

namespace roboss {
namespace {

// A tetrahedron; one element a line.
const std::string kGood = R"(<COLLADA version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="a"><surface type="2D"><init_from>picture</init_from></surface></newparam>
<newparam sid="b"><sampler2D><source>a</source></sampler2D></newparam>
<technique sid="t"><lambert><diffuse><texture texture="b" texcoord="uv"/></diffuse></lambert></technique>
</profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="f" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array><technique_common>
<accessor source="#f" count="4" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="4" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 1 0 1 3 0 3 2 1 2 3</p>
</triangles>
</mesh></geometry></library_geometries>
<library_nodes><node id="part"><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="m" target="#m"/>
</technique_common></bind_material></instance_geometry></node></library_nodes>
<library_visual_scenes><visual_scene id="w"><node id="n">
<instance_node url="#part"/>
</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#w"/></scene></COLLADA>
)";

std::string with(const std::string& old, const std::string& fresh) {
    std::string text = kGood;
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return text.replace(at, old.size(), fresh);
}

Result<> check_collada(const std::string& path, const std::string& text) {
    const auto file = checked_collada(path, text);
    if (!file) return file.error();
    return Ok{};
}

std::size_t triangles_in(const std::string& text) {
    const test::Folder folder;
    const auto mesh = read_mesh({folder.write("a.dae", text), {1, 1, 1}, "", false});
    const auto parts = read_mesh_parts({folder.write("b.dae", text), {1, 1, 1}, "", false});
    EXPECT_EQ(mesh.ok(), parts.ok());
    return mesh.ok() ? mesh.value().mesh.triangles.size() : 0;
}

void expect_refused(int line, const std::string& text) {
    const Result<> checked = check_collada("a.dae", text);
    ASSERT_FALSE(checked.ok()) << text;
    EXPECT_NE(checked.error().remedy.find("line " + std::to_string(line) + " of a.dae"), std::string::npos)
        << checked.error().text();
    EXPECT_EQ(triangles_in(text), 0u);
}

const std::string kTriangles = "<triangles count=\"4\"", kEnd = "</triangles>",
                  kList = "<p>0 2 1 0 1 3 0 3 2 1 2 3</p>";

void expect_read(const std::string& text, std::size_t triangles = 4) {
    EXPECT_TRUE(check_collada("a.dae", text).ok()) << check_collada("a.dae", text).error().text();
    EXPECT_EQ(triangles_in(text), triangles);
}

TEST(CheckCollada, AGoodFileIsRead) {
    EXPECT_TRUE(check_collada("a.dae", kGood).ok());
    EXPECT_EQ(triangles_in(kGood), 4u);
}

TEST(CheckCollada, CommentsAreNotRead) {
    const std::string text = with(kList, "<!-- <p>0 one 2</p> -->" + kList);
    EXPECT_TRUE(check_collada("a.dae", text).ok());
    EXPECT_EQ(triangles_in(text), 4u);
}

TEST(CheckCollada, AnAccessorReadsNoFurtherThanItsArray) {
    expect_refused(11, with("count=\"12\"", "count=\"0\""));
    expect_refused(11, with("count=\"4\" stride=\"3\"", "count=\"5\" stride=\"3\""));
    expect_refused(11, with("stride=\"3\"", "stride=\"4294967295\""));
    expect_refused(11, with("stride=\"3\"", "stride=\"3\" offset=\"1\""));
    expect_refused(11,
                   with("</float_array>", "</float_array><Name_array id=\"f\" count=\"1\">x</Name_array>"));
}

// As in the files of a gripper by Robotiq that many repositories hold.
TEST(CheckCollada, AnArrayOfALaterMeshMayHaveTheIdOfAnEarlierOne) {
    const std::string begin = "<geometry id=\"g\"><mesh>", end = "</mesh></geometry>";
    const std::size_t first = kGood.find(begin), last = kGood.find(end);
    std::string larger = kGood.substr(first, last + end.size() - first);
    const auto replace = [&](const std::string& old, const std::string& fresh) {
        larger.replace(larger.find(old), old.size(), fresh);
    };
    replace("id=\"g\"", "id=\"h\"");
    replace("count=\"12\">", "count=\"15\">1 1 1 ");
    replace("count=\"4\" stride", "count=\"5\" stride");
    const std::string text = with(end, end + larger);
    EXPECT_TRUE(check_collada("a.dae", text).ok());
    EXPECT_EQ(triangles_in(text), 4u);
}

TEST(CheckCollada, FacesAreAsManyAsAnnounced) {
    expect_refused(14, with(kList, kList + kList));
    expect_refused(14, with(kList, kList.substr(0, kList.size() - 4) + kList + "</p>"));
    expect_refused(14, with(kList, ""));
    std::string text = with(kTriangles, "<polygons count=\"3\"");
    text.replace(text.find(kEnd), kEnd.size(), "</polygons>");
    expect_refused(14, text);
    text = with(kTriangles, "<polylist count=\"4\"");
    text.replace(text.find(kEnd), kEnd.size(), "<vcount>3 3 3 3</vcount></polylist>");
    expect_refused(15, text);
    text = with(kTriangles, "<tristrips count=\"1\"");
    text.replace(text.find(kEnd), kEnd.size(), "</tristrips>");
    text.replace(text.find(kList), kList.size(), "<p>0</p>");
    expect_refused(15, text);
}

TEST(CheckCollada, AnIndexIsANumber) {
    expect_refused(15, with("<p>0 2 1", "<p>0 2x 1"));
    expect_refused(15, with("<p>0 2 1", "<p>0 <!-- 2 --> 1e9 1"));
}

TEST(CheckCollada, NothingRefersToItself) {
    expect_refused(3, with("<source>a</source>", "<source>b</source>"));
    expect_refused(18, with("<node id=\"part\">", "<node id=\"part\"><instance_node url=\"#part\"/>"));
    std::string many;
    for (int i = 0; i < 30; ++i) {
        const std::string next = "<instance_node url=\"#n" + std::to_string(i + 1) + "\"/>";
        many += "<node id=\"n" + std::to_string(i) + "\">" + next + next + "</node>";
    }
    std::string text = with("<library_nodes>", "<library_nodes>" + many);
    const std::string part = "url=\"#part\"";
    EXPECT_FALSE(check_collada("a.dae", text.replace(text.find(part), part.size(), "url=\"#n0\"")).ok());
}

TEST(CheckCollada, XmlThatIsCutShortIsAnErrorWithItsLine) {
    expect_refused(15, kGood.substr(0, kGood.find(kList) + 4));
    for (std::size_t length = 0; length < kGood.rfind('>'); length += 7)
        EXPECT_FALSE(check_collada("a.dae", kGood.substr(0, length)).ok()) << length;
}

TEST(CheckCollada, CountsAreDigits) {
    for (const std::string bad :
         {"-1", "0x4", "4.0", "four", "", "4294967296", "18446744073709551620", "4 4"}) {
        const auto is = [&](const char* name) { return std::string(name) + "=\"" + bad + "\""; };
        expect_refused(11, with("count=\"4\" stride", is("count") + " stride"));
        expect_refused(11, with("stride=\"3\"", is("stride")));
        expect_refused(11, with("stride=\"3\"", "stride=\"3\" " + is("offset")));
        expect_refused(10, with("count=\"12\"", is("count")));
        expect_refused(14, with("count=\"4\" material", is("count") + " material"));
        expect_refused(14, with("offset=\"0\"", is("offset")));
    }
    expect_read(with("count=\"4\" stride=\"3\"", "count=\" 4\n\" stride=\"0003\" offset=\"0\""));
}

TEST(CheckCollada, NothingStandsBesideItsElement) {
    const std::string damaged = with("count=\"4\" stride", "count=\"4000\" stride");
    expect_refused(1, "<extra/>" + damaged);
    expect_refused(1, "<collada/>");
    expect_refused(25, kGood + damaged);
    expect_refused(26, kGood + "\n<COLLADA/>");
    expect_read("<?xml version=\"1.0\"?><!-- by hand -->" + kGood + "<!-- end -->");
}

std::string nested(int nodes) {
    std::string begin, end;
    for (int i = 0; i < nodes; ++i) begin += "<node>", end += "</node>";
    const std::string text =
        with("<instance_node url=\"#part\"/>", begin + "\n<instance_node url=\"#part\"/>" + end);
    return text;
}

TEST(CheckCollada, ADeepHierarchyIsRead) {
    expect_read(nested(450));
    expect_refused(22, nested(1000));
    std::string deep;
    for (int i = 0; i < 100'000; ++i) deep += "<node>";
    EXPECT_FALSE(check_collada("a.dae", with("<instance_node url=\"#part\"/>", deep)).ok());
}

TEST(CheckCollada, FacesHaveVerticesWithOnePosition) {
    const std::string input = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";
    expect_refused(15, with(input, ""));
    expect_refused(14, with(input, "<input semantic=\"VERTEX\" source=\"#s\" offset=\"0\"/>"));
    expect_refused(15, with("semantic=\"POSITION\"", "semantic=\"NORMAL\""));
    expect_refused(15, with(input, input + "<input semantic=\"POSITION\" source=\"#s\" offset=\"0\"/>"));
    expect_refused(14, with(input, input + "<input semantic=\"NORMAL\" source=\"#n\" offset=\"0\"/>"));
    expect_read(with(input, input + "<input semantic=\"NORMAL\" source=\"#s\" offset=\"0\"/>"));
}

TEST(CheckCollada, AColourHasFourNumbers) {
    const std::string input = "offset=\"0\"/>",
                      colour = "<input semantic=\"COLOR\" source=\"#s\" offset=\"0\"/>";
    std::string text = with(input, input + colour);
    expect_read(text);
    const std::string last = "<param name=\"Z\"/>";
    text.replace(text.find(last), last.size(), "<param name=\"Z\" type=\"float4x4\"/>");
    expect_refused(11, text);
}

TEST(CheckCollada, ASourceThatIsReadAnewBehindTheFacesIsNotUsed) {
    const std::size_t begin = kGood.find("<source id=\"s\">"), end = kGood.find("<vertices");
    const std::size_t faces = kGood.find(kTriangles), behind = kGood.find(kEnd) + kEnd.size();
    std::string text = kGood;
    text.insert(behind, "\n" + kGood.substr(begin, end - begin) + kGood.substr(faces, behind - faces));
    expect_refused(18, text);
}

TEST(CheckCollada, NumbersOfCornersAreDigitsAndAsManyAsFaces) {
    const auto list = [](const std::string& counts) {
        std::string text = with(kTriangles, "<polylist count=\"4\"");
        text.replace(text.find(kEnd), kEnd.size(), "</polylist>");
        return text.insert(text.find(kList), "<vcount>" + counts + "</vcount>");
    };
    expect_read(list("3 3\n3 3"));
    for (const char* bad :
         {"", "3 3 3", "3 3 3 -3", "3 3 3 4", "3 3 3 x", "4294967295 4294967295 4294967295 3"})
        expect_refused(15, list(bad));
}

// As SketchUp writes them.
TEST(CheckCollada, LinesBesideFacesMayHaveAWrongCount) {
    const std::string lines =
        "<lines count=\"7\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 1 2</p></lines>";
    expect_read(with(kTriangles, lines + kTriangles));
    std::string many = with(kTriangles, lines + kTriangles);
    expect_refused(14, many.replace(many.find("count=\"7\""), 9, "count=\"4294967295\""));
}

TEST(CheckCollada, NegativeIndicesAreTheFirst) {
    expect_read(with("<p>0 2 1", "<p>-1 2 1"));
}

TEST(CheckCollada, AMeshThatStandsInManyNodesIsNotCopiedWithoutEnd) {
    std::string many;
    for (int i = 0; i < 12; ++i) {
        const std::string next = "<instance_node url=\"#n" + std::to_string(i + 1) + "\"/>";
        many += "<node id=\"n" + std::to_string(i) + "\">" + next + next + next + "</node>";
    }
    many += "<node id=\"n12\"><instance_geometry url=\"#g\"/></node>";
    std::string text = with("<library_nodes>", "<library_nodes>" + many);
    expect_read(text);  // no scene has them
    const std::string part = "url=\"#part\"";
    text.replace(text.find(part), part.size(), "url=\"#n0\"");
    const auto checked = check_collada("a.dae", text);
    ASSERT_FALSE(checked.ok());
    EXPECT_NE(checked.error().message.find("nodes"), std::string::npos) << checked.error().text();
}

TEST(CheckCollada, AFileOfAnotherEncodingIsRead) {
    std::string wide = "\xFF\xFE";
    for (const char c : kGood) wide += std::string(1, c) + '\0';
    expect_read(wide);
}

TEST(CheckCollada, AssertionsOfTheReaderAreErrors) {
    const std::string node = "<node id=\"n\">";
    EXPECT_EQ(triangles_in(with(node, node + "<skew>1 2 3 4 5 6 7</skew>")), 0u);
    expect_read(with("<init_from>picture</init_from>", "<init_from/>"));
    const std::string effects = "<library_effects>";
    expect_read(with(
        effects, "<library_images><image id=\"picture\"><init_from/></image></library_images>" + effects));
    expect_read(
        with(effects,
             "<library_images><image id=\"picture\"><init_from>file://</init_from></image></library_images>" +
                 effects));
}

}  // namespace
}  // namespace roboss
