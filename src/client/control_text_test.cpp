// Words of requests become requests; whatever is not one is refused with a code.
#include "client/control_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace roboss {
namespace {

using Words = std::vector<std::string>;

TEST(ControlText, ReadsEachRequest) {
    const std::vector<std::pair<Words, ControlAction>> cases{
        {{"status"}, GetStatus{true}},
        {{"groups"}, GetGroups{}},
        {{"bounds"}, GetBounds{}},
        {{"profile"}, GetProfile{}},
        {{"pause"}, PauseRun{}},
        {{"resume"}, ResumeRun{}},
        {{"quit"}, QuitRun{}},
        {{"step"}, StepRun{1}},
        {{"step", "100"}, StepRun{100}},
        {{"speed", "2.5"}, SetSpeed{SetSpeed::Kind::kFactor, 2.5}},
        {{"speed", "max"}, SetSpeed{SetSpeed::Kind::kMax}},
        {{"speed", "world"}, SetSpeed{SetSpeed::Kind::kWorld}},
        {{"window", "auto"}, SetWindow{0}},
        {{"window", "16"}, SetWindow{16}},
        {{"simulators", "add"}, AddSimulator{}},
        {{"simulators", "remove"}, RemoveSimulator{}},
        {{"simulators", "kill", "3"}, KillSimulator{3}},
        {{"save", "a.roboss"}, SaveRun{"a.roboss"}},
        {{"save", "a.roboss", "overwrite"}, SaveRun{"a.roboss", true}},
        {{"rewind", "12.5"}, RewindRun{0, 12.5}},
        {{"rewind", "@12.5"}, RewindRun{0, 12.5}},
        {{"rewind", "#2@12.5"}, RewindRun{2, 12.5}},
        {{"timeline"}, GetTimeline{}},
        {{"preview", "12.5"}, PreviewRun{0, 12.5}},
        {{"preview", "#2@12.5"}, PreviewRun{2, 12.5}},
        {{"bookmark", "the jump"}, AddBookmark{"the jump"}},
        {{"bookmark", "the jump", "#2@12.5"}, AddBookmark{"the jump", 2, 12.5}},
        {{"bookmark", "remove", "3"}, RemoveBookmark{3}},
        {{"accuracy", "high", "tolerance=1e-10"}, ChangeAccuracy{"high", {{"tolerance", 1e-10}}}},
        {{"add", "ball.sdf", "<sdf/>", "1 2 3 0 0 0", "ball", "on-ground"},
         AddModels{"ball.sdf", "<sdf/>", {{1, 2, 3}, {}}, "ball", {}, true}},
        {{"add", "ball.sdf", "<sdf/>", "0 0 0 0 0 0", "", "a 1 2 3 0 0 0", "on-ground"},
         AddModels{"ball.sdf", "<sdf/>", {}, "", {{"a", {{1, 2, 3}, {}}}}, true}},
        {{"add", "ball.sdf", "<sdf/>", "1 2 3 0 0 0", "ball"},
         AddModels{"ball.sdf", "<sdf/>", {{1, 2, 3}, {}}, "ball"}},
        {{"add", "ball.sdf", "<sdf/>", "0 0 0 0 0 0", "", "a 1 2 3 0 0 0 # first\n\nb 0 0 0 0 0 0"},
         AddModels{"ball.sdf", "<sdf/>", {}, "", {{"a", {{1, 2, 3}, {}}}, {"b", {}}}}},
        {{"reset"}, ResetRun{}},
        {{"reset", "start"}, ResetRun{}},
        {{"reset", "save"}, ResetRun{ResetRun::To::kLastSave}},
        {{"remove", "a", "b"}, RemoveRobots{{"a", "b"}}},
        {{"copy", "a", "b", "1 2 3 0 0 0", "a", "c", "0 0 0 0 0 0"},
         CopyRobots{{{"a", "b", {{1, 2, 3}, {}}}, {"a", "c", {}}}}},
        {{"restore", "a", "b"}, RestoreRobots{{"a", "b"}}}};
    std::vector<bool> met(std::variant_size_v<ControlAction>, false);
    for (const auto& [words, action] : cases) {
        met[action.index()] = true;
        const Result<ControlAction> parsed = parse_control(words);
        ASSERT_TRUE(parsed.ok()) << words[0] << ": " << parsed.error().text();
        EXPECT_EQ(parsed.value(), action) << words[0];
        EXPECT_TRUE(std::string(control_verb(action)).starts_with(words[0]));
    }
    EXPECT_EQ(std::count(met.begin(), met.end(), true), std::ssize(met)) << "each kind of request";
}

TEST(ControlText, RefusesWhatIsNoRequestAndNamesTheKindOfMistake) {
    const std::vector<std::pair<Words, std::string>> cases{
        {{}, "unknown-request"},
        {{"fly"}, "unknown-request"},
        {{"pause", "now"}, "unknown-request"},
        {{"add", "f", "", "0 0 0 0 0 0", "", ""}, "bad-pose"},
        {{"add", "f", "", "0 0 0 0 0 0", "", "a 1 2 3"}, "bad-pose"},
        {{"add", "f", "", "0 0 0 0 0 0", "", "a 1e99 2 3 0 0 0"}, "bad-pose"},
        {{"reset", "now"}, "bad-value"},
        {{"copy", "a", "b"}, "unknown-request"},
        {{"copy", "a", "b", "1 2 3 0 0 0", "a"}, "unknown-request"},
        {{"copy", "a", "b", "1 2 3"}, "bad-pose"},
        {{"copy", "a", "b", "1e99 2 3 0 0 0"}, "bad-value"},
        {{"copy", "a", "", "1 2 3 0 0 0"}, "bad-value"},
        {{"restore"}, "unknown-request"},
        {{"simulators", "sing"}, "unknown-request"},
        {{"simulators", "kill"}, "unknown-request"},
        {{"simulators", "kill", "-1"}, "bad-value"},
        {{"step", "0"}, "bad-value"},
        {{"step", "1.5"}, "bad-value"},
        {{"step", "1e300"}, "bad-value"},
        {{"speed", "0"}, "bad-value"},
        {{"speed", "-1"}, "bad-value"},
        {{"speed", "nan"}, "bad-value"},
        {{"window", "0"}, "bad-value"},
        {{"window", "1e9"}, "bad-value"},
        {{"rewind", "soon"}, "bad-value"},
        {{"rewind", "-1"}, "bad-value"},
        {{"rewind", "#0@1"}, "bad-value"},
        {{"rewind", "2@1"}, "bad-value"},
        {{"preview", "-1"}, "bad-value"},
        {{"bookmark", ""}, "bad-value"},
        {{"bookmark", "here", "-1"}, "bad-value"},
        {{"bookmark", "remove", "0"}, "bad-value"},
        {{"save", ""}, "bad-value"},
        {{"accuracy", "tolerance=much"}, "bad-value"},
        {{"add", "f", "c", "1 2 3", "n"}, "bad-pose"},
        {{"add", "f", "c", "1e300 2 3 0 0 0", "n"}, "bad-pose"}};
    for (const auto& [words, code] : cases) {
        const Result<ControlAction> parsed = parse_control(words);
        ASSERT_FALSE(parsed.ok()) << words[0];
        EXPECT_EQ(parsed.error().code, code) << (words.empty() ? "" : words.back());
        EXPECT_FALSE(parsed.error().remedy.empty());
    }
}

}  // namespace
}  // namespace roboss
