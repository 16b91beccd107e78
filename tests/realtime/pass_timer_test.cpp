#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/pass_timer.h>

namespace welkin {
namespace {

TEST(PassTimer, KnowsDriversThatDrawOnTheProcessor) {
  EXPECT_TRUE(is_software_renderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(is_software_renderer(
      "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)), SwiftShader driver)"));
  EXPECT_FALSE(is_software_renderer("NVIDIA H200/PCIe/SSE2"));
  EXPECT_FALSE(is_software_renderer("Mesa Intel(R) UHD Graphics 620 (KBL GT2)"));
}

TEST(PassTimer, NothingIsTimedUnlessAsked) {
  const HeadlessContext context;
  PassTimer timer;
  timer.begin_frame();
  { const PassTimer::Scope timed(timer, "pass"); }
  EXPECT_TRUE(timer.passes().empty());
}

// Sleeping takes at least as long as asked; how much longer, nobody knows, so only lower bounds and sums are certain.
TEST(PassTimer, PassesWithinPassesByTheClock) {
  using std::chrono::milliseconds;
  const HeadlessContext context;
  PassTimer timer;
  timer.enabled = true;
  timer.begin_frame();
  {
    const PassTimer::Scope outer(timer, "outer");
    std::this_thread::sleep_for(milliseconds(4));
    {
      const PassTimer::Scope inner(timer, "inner");
      std::this_thread::sleep_for(milliseconds(6));
    }
    const PassTimer::Scope nothing(timer, "nothing");
  }
  const std::vector<PassTime> passes = timer.passes();
  ASSERT_EQ(passes.size(), 3u);
  EXPECT_EQ(passes[0].name, "outer");
  EXPECT_EQ(passes[1].name, "inner");
  EXPECT_EQ(passes[2].name, "nothing");
  EXPECT_EQ(passes[0].depth, 0);
  EXPECT_EQ(passes[1].depth, 1);
  EXPECT_EQ(passes[2].depth, 1);
  EXPECT_GE(passes[1].milliseconds, 6);
  EXPECT_GE(passes[0].milliseconds, passes[1].milliseconds + passes[2].milliseconds + 4);
  EXPECT_GE(passes[2].milliseconds, 0);
  timer.begin_frame();
  EXPECT_TRUE(timer.passes().empty());
}

// Queries may not lie within each other, so nested passes are cut into stretches. llvmpipe answers (with times that mean little),
// which is enough to see that every pass arrives, in order, without an error, and that no query is left.
TEST(PassTimer, NestedAndEmptyPassesByQueries) {
  const HeadlessContext context;
  {
    PassTimer timer;
    timer.enabled = true;
    timer.mode = TimerMode::queries;
    for (int frame = 0; frame < 40; ++frame) {
      timer.begin_frame();
      {
        const PassTimer::Scope a(timer, "a");
        glFlush();
        { const PassTimer::Scope b(timer, "b"); }
        {
          const PassTimer::Scope c(timer, "c");
          const PassTimer::Scope d(timer, "d");
        }
      }
      const PassTimer::Scope e(timer, "e");
    }
    glFinish();
    timer.begin_frame();
    const std::vector<PassTime> passes = timer.passes();
    ASSERT_EQ(passes.size(), 5u);
    const std::pair<const char*, int> expected[] = {{"a", 0}, {"b", 1}, {"c", 1}, {"d", 2}, {"e", 0}};
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(passes[i].name, expected[i].first);
      EXPECT_EQ(passes[i].depth, expected[i].second);
      EXPECT_GE(passes[i].milliseconds, 0);
      EXPECT_LT(passes[i].milliseconds, 10000);
    }
    EXPECT_GE(passes[0].milliseconds, passes[1].milliseconds + passes[2].milliseconds);
    EXPECT_GE(passes[2].milliseconds, passes[3].milliseconds);
    // Queries are used again: 8 stretches a frame and at most 9 frames on their way, the one under way included.
    EXPECT_LE(living_gl_objects()[static_cast<std::size_t>(GlKind::query)], 8 * 9);
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    timer.enabled = false;
    timer.begin_frame();
    EXPECT_EQ(living_gl_objects()[static_cast<std::size_t>(GlKind::query)], 0);
    EXPECT_TRUE(timer.passes().empty());
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
}

TEST(PassTimer, ChangingTheModeBetweenFramesLosesNothingButOldTimes) {
  const HeadlessContext context;
  {
    PassTimer timer;
    timer.enabled = true;
    for (int frame = 0; frame < 12; ++frame) {
      timer.mode = frame % 3 == 0 ? TimerMode::queries : TimerMode::clock;
      timer.enabled = frame % 4 != 1;
      timer.begin_frame();
      const PassTimer::Scope pass(timer, "pass");
    }
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
}

}  // namespace
}  // namespace welkin
