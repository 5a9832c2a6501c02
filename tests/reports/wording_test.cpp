// Numbers, places and hostile names as text.
#include "reports/wording.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/contact.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"

namespace broadside::reports {
namespace {

TEST(Figures, HaveSensibleDigits) {
  EXPECT_EQ(figure(0.0), "0");
  EXPECT_EQ(figure(1234.56), "1235");
  EXPECT_EQ(figure(0.012345), "0.0123");
  EXPECT_EQ(figure(9.996), "10");
  EXPECT_EQ(figure(1.2e-7), "1.2e-7");
  EXPECT_EQ(figure(-2.5), "-2.5");
  EXPECT_EQ(figure(std::numeric_limits<double>::quiet_NaN()), "not a number");
  EXPECT_EQ(figure(std::numeric_limits<double>::infinity()), "infinite");
}

TEST(Figures, TakeSiPrefixesWhereTheUnitHasThem) {
  EXPECT_EQ(quantity(0.00123, "m"), "1.23 mm");
  EXPECT_EQ(quantity(999.96, "m"), "1 km");
  EXPECT_EQ(quantity(-4.5e-6, "s"), "-4.5 \xC2\xB5s");
  EXPECT_EQ(quantity(1.5e-13, "J"), "1.5e-13 J");
  EXPECT_EQ(quantity(0.0, "m"), "0 m");
  EXPECT_EQ(quantity(12.0, "kg m"), "12 kg m");
  EXPECT_EQ(quantity(1234567.0, "pairs"), "1234567 pairs");
  EXPECT_EQ(quantity(0.25, ""), "0.25");
}

TEST(Figures, ThatWereComparedShowTheirDifference) {
  const Compared c = compared(1.0000001, 1.0, "m");
  EXPECT_NE(c.measured, c.limit);
  EXPECT_EQ(c.limit, "1 m");
  EXPECT_EQ(compared(0.5, 1.0, "m").measured, "500 mm");
}

TEST(Figures, OfTimesKeepThreeDigitsAndNeverRoundToAZero) {
  const TimeUnit ms = time_unit_for(0.002);
  EXPECT_EQ(ms.name, "ms");
  EXPECT_EQ(time_in(ms, 0.001234), "1.23");
  EXPECT_EQ(time_in(ms, 0.12345), "123");
  EXPECT_EQ(time_in(ms, 0.000012), "0.012");
  EXPECT_EQ(time_in(ms, 1e-8), "<0.001");
  EXPECT_EQ(time_in(ms, 0.0), "0.000");
  EXPECT_EQ(time_unit_for(3e-5).name, "\xC2\xB5s");
}

TEST(Places, NameStepBodiesAndFaces) {
  EXPECT_EQ(place_text({.step = 12, .bodies = {3, 17}, .field = "pairs"}), "step 12, bodies 3 and 17, pairs");
  EXPECT_EQ(place_text({.step = 12, .bodies = {3, core::kFirstFace + 2}, .field = ""}), "step 12, body 3 and face -y");
  EXPECT_EQ(place_text({.step = -1, .bodies = {5}, .field = ""}), "body 5");
  EXPECT_EQ(place_text({.step = -1, .bodies = {1, 2, 3}, .field = ""}), "bodies 1, 2 and 3");
  EXPECT_EQ(place_text({}), "no single frame");
}

TEST(Escape, HtmlHasNoMarkupLeft) {
  EXPECT_EQ(html("</script><script>alert('1')</script>&\""),
            "&lt;/script&gt;&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt;&amp;&quot;");
}

TEST(Escape, MarkdownHasNoMarkupMentionOrLinkLeft) {
  EXPECT_EQ(markdown("a|b"), "a\\|b");
  EXPECT_EQ(markdown("<b>"), "&lt;b&gt;");
  EXPECT_EQ(markdown("[x](http://y)"), "\\[x\\](http&#58;//y)");
  EXPECT_EQ(markdown("@all #12"), "&#64;all &#35;12");
  EXPECT_EQ(markdown("two\nlines"), "two lines");
}

TEST(Escape, ControlCharactersAndBrokenUtf8AreReplaced) {
  const std::string r = "\xEF\xBF\xBD";
  EXPECT_EQ(printable("\x1B[31mred"), r + "[31mred");
  EXPECT_EQ(printable("\xFF"), r);
  EXPECT_EQ(printable("\xC0\xAF"), r + r);          // overlong slash
  EXPECT_EQ(printable("\xED\xA0\x80"), r + r + r);  // surrogate
  EXPECT_EQ(printable("\xE2\x80\xAE"), r);          // right-to-left override
  EXPECT_EQ(printable("\xEF\xBF\xBF"), r);          // XML forbids U+FFFF
  EXPECT_EQ(printable("\xC3\xA9\xF0\x9F\x90\x87"), "\xC3\xA9\xF0\x9F\x90\x87");
  EXPECT_EQ(printable("\xC3"), r);  // cut in the middle
}

TEST(Escape, ClippingCountsCharactersNotBytes) {
  EXPECT_EQ(clipped("\xC3\xA9\xC3\xA9\xC3\xA9", 3), "\xC3\xA9\xC3\xA9\xC3\xA9");
  EXPECT_EQ(clipped("abcdef", 4), "abc\xE2\x80\xA6");
}

}  // namespace
}  // namespace broadside::reports
