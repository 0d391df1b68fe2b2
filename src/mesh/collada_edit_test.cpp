// The elements of COLLADA files, before and after.
#include "mesh/collada_edit.h"

#include <gtest/gtest.h>

#include <functional>
#include <sstream>

namespace roboss {
namespace {

using Edit = std::function<void(pugi::xml_node)>;

std::string after(const Edit& edit, const std::string& elements) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(("<COLLADA>" + elements + "</COLLADA>").c_str()));
    edit(document.document_element());
    std::ostringstream text;
    for (const auto child : document.document_element().children()) child.print(text, "", pugi::format_raw);
    return text.str();
}

std::string at_rest(const std::string& elements) {
    return after(put_collada_at_rest, elements);
}

std::string without_pictures(const std::string& elements) {
    return after(drop_collada_pictures, elements);
}

TEST(ColladaEdit, PicturesAreTakenOutWhole) {
    EXPECT_EQ(without_pictures("<diffuse><texture texture='t'/></diffuse>"), "<diffuse/>");
    EXPECT_EQ(without_pictures("<x/><library_images><image id='i'/></library_images><y/>"), "<x/><y/>");
    EXPECT_EQ(without_pictures("<newparam sid='s'><sampler2D/></newparam><y/>"), "<y/>");
    EXPECT_EQ(without_pictures("<textures>1</textures>"), "<textures>1</textures>");
}

TEST(ColladaEdit, ATextIsOneWithoutItsComments) {
    EXPECT_EQ(at_rest("<p>0 1<!-- 7 -->2 3</p>"), "<p>0 1 2 3</p>");
    EXPECT_EQ(at_rest("<p>0<![CDATA[1]]> 2</p>"), "<p>0 1  2</p>");
    EXPECT_EQ(at_rest("<v><!-- <i/> --><j/><!----></v>"), "<v><j/></v>");
}

TEST(ColladaEdit, SkinsAndMorphsBecomeTheirGeometry) {
    const std::string library =
        "<library_controllers><controller name='s' id='skin'><skin source='#morph'/></controller>"
        "<controller id='morph'><morph method='NORMALIZED' source='#shape'/></controller>"
        "</library_controllers >";
    EXPECT_EQ(at_rest(library + "<node><instance_controller url='#skin'><x/></instance_controller>"
                                "<instance_controller url='#none'/></node>"),
              "<node><instance_geometry url=\"#shape\"><x/></instance_geometry>"
              "<instance_geometry url=\"#\"/></node>");
    EXPECT_EQ(at_rest("<node><instance_geometry url=\"#shape\"/></node>"),
              "<node><instance_geometry url=\"#shape\"/></node>");
    const std::string ring =
        "<controller id='a'><skin source='#b'/></controller>"
        "<controller id='b'><skin source='#a'/></controller>";
    EXPECT_EQ(at_rest("<library_controllers>" + ring + "</library_controllers>"), "");
}

TEST(ColladaEdit, AnimationsAndPicturesInsideTheFileAreTakenOut) {
    EXPECT_EQ(at_rest("<a/><library_animations><b/></library_animations><c/><library_animation_clips/>"),
              "<a/><c/>");
    EXPECT_EQ(at_rest("<image id='i'><init_from><hex format='PNG'>00ff</hex></init_from></image>"),
              "<image id=\"i\"><init_from/></image>");
}

}  // namespace
}  // namespace roboss
