// The text of COLLADA files, before and after.
#include "mesh/repair_collada.h"

#include <gtest/gtest.h>

namespace roboss {
namespace {

TEST(RepairCollada, NumbersBeginAtTheirElement) {
    EXPECT_EQ(repaired_collada("<p>\n  0 1\t2 </p>"), "<p>0 1\t2 </p>");
    EXPECT_EQ(repaired_collada("<a> -1.5</a> <b> text</b>"), "<a>-1.5</a> <b> text</b>");
}

TEST(RepairCollada, PicturesAreTakenOutWhole) {
    EXPECT_EQ(repaired_collada("<diffuse><texture texture='t'/></diffuse>"), "<diffuse></diffuse>");
    EXPECT_EQ(repaired_collada("<x/><library_images><image id='i'/></library_images><y/>"), "<x/><y/>");
    EXPECT_EQ(repaired_collada("<textures>1</textures>"), "<textures>1</textures>");
}

TEST(RepairCollada, CommentsAreTakenOut) {
    EXPECT_EQ(repaired_collada("<v><!-- <i/> --><j/><!----></v><!-- open"), "<v><j/></v><!-- open");
}

TEST(RepairCollada, SkinsAndMorphsBecomeTheirGeometry) {
    const std::string library =
        "<library_controllers><controller name='s' id='skin'><skin source='#morph'/></controller>"
        "<controller id=\"morph\"><morph method='NORMALIZED' "
        "source='#shape'/></controller></library_controllers>";
    EXPECT_EQ(collada_at_rest(library + "<node><instance_controller url='#skin'><x/></instance_controller>"
                                        "<instance_controller url='#none'/></node>"),
              "<node><instance_geometry url=\"#shape\"><x/></instance_geometry>"
              "<instance_geometry url=\"#\"/></node>");
    EXPECT_EQ(collada_at_rest("<node><instance_geometry url='#shape'/></node>"), "");
    EXPECT_EQ(collada_at_rest("<a/><library_animations><b/></library_animations><c/>"), "<a/><c/>");
    for (std::size_t length = 0; length <= library.size(); ++length)
        EXPECT_LE(collada_at_rest(library.substr(0, length)).size(), length);
}

TEST(RepairCollada, TextThatIsCutShortDoesNoHarm) {
    const std::string whole = "<library_images><image/></library_images><p> 1 2</p><texture/>";
    for (std::size_t length = 0; length <= whole.size(); ++length)
        EXPECT_LE(repaired_collada(whole.substr(0, length)).size(), length);
}

}  // namespace
}  // namespace roboss
