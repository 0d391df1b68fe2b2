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
    expect_refused(11, with("count=\"12\"", "count=\"-1\""));
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
    expect_refused(14, text);
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
    const auto checked = check_collada("a.dae", with("<library_nodes>", "<library_nodes>" + many));
    EXPECT_FALSE(checked.ok());
}

TEST(CheckCollada, XmlThatIsCutShortIsAnErrorWithItsLine) {
    expect_refused(15, kGood.substr(0, kGood.find(kList) + 4));
    for (std::size_t length = 0; length < kGood.rfind('>'); length += 7)
        EXPECT_FALSE(check_collada("a.dae", kGood.substr(0, length)).ok()) << length;
}

}  // namespace
}  // namespace roboss
