#include "lychnite/app/input_script.h"

#include <gtest/gtest.h>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

using Kind = ScriptStep::Kind;

ScriptStep only(const std::string& line) {
  const auto steps = parseScript(line, "script");
  EXPECT_EQ(steps.size(), 1u) << line;
  return steps.empty() ? ScriptStep{} : steps.front();
}

TEST(InputScript, ReadsEveryEvent) {
  EXPECT_EQ(only("wait 10").count, 10);
  EXPECT_EQ(only("wait rest").kind, Kind::kWaitRest);
  EXPECT_DOUBLE_EQ(only("wait 5%").number, 0.05);
  EXPECT_EQ(only("move 3,4").to.at, glm::dvec2(3, 4));
  EXPECT_EQ(only("press right").button, 1);
  EXPECT_EQ(only("release").button, 0);
  EXPECT_EQ(only("click @size:0.25,0.5").to.control, "size");
  EXPECT_EQ(only("click @size:0.25,0.5").to.at, glm::dvec2(0.25, 0.5));
  EXPECT_EQ(only("click @size middle").button, 2);
  const ScriptStep drag = only("drag 1,2 @b:1,1 right 20");
  EXPECT_EQ(drag.from.at, glm::dvec2(1, 2));
  EXPECT_EQ(drag.to.control, "b");
  EXPECT_EQ(drag.button, 1);
  EXPECT_EQ(drag.count, 20);
  EXPECT_DOUBLE_EQ(only("scroll -1.5").number, -1.5);
  EXPECT_EQ(only("key ctrl+shift+Z").chord, (KeyChord{.key = "z", .ctrl = true, .shift = true}));
  EXPECT_EQ(only("key [").chord.key, "[");
  EXPECT_EQ(only("type \"2 cm\"").text, "2 cm");
  EXPECT_EQ(only("drop a.ply \"b c.ply\"").texts, (std::vector<std::string>{"a.ply", "b c.ply"}));
  EXPECT_EQ(only("resize 640 480").to.at, glm::dvec2(640, 480));
  EXPECT_EQ(only("minimise").kind, Kind::kMinimise);
  EXPECT_EQ(only("restore").kind, Kind::kRestore);
  EXPECT_EQ(only("screenshot x.png").text, "x.png");
  EXPECT_EQ(only("quit").kind, Kind::kQuit);
}

TEST(InputScript, SkipsCommentsAndKeepsLines) {
  const auto steps = parseScript("# first\n\n  wait 1  # one\nquit\n", "script");
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].line, 3);
  EXPECT_EQ(steps[1].line, 4);
}

TEST(InputScript, SaysWhereItIsWrong) {
  for (const char* line :
       {"wait", "wait -1", "wait 1.5", "move 1", "move @", "click 1,2 fourth", "drag 1,2", "key ctr+z",
        "key foo", "resize 0 5", "type \"open", "jump 3", "drop", "screenshot"}) {
    try {
      parseScript(std::string("wait 1\n") + line, "s.txt");
      ADD_FAILURE() << line;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), Error::Kind::kUsage);
      EXPECT_EQ(error.parts().where, "s.txt:2") << line;
    }
  }
  try {
    parseScript("clik 1,2", "s.txt");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.parts().todo.find("click"), std::string::npos);
  }
}

}  // namespace
}  // namespace lychnite
