// Text of any usual encoding in one form.
#include "core/log/plain_text.hpp"

#include <gtest/gtest.h>

namespace weaveform {
namespace {

const std::string words = "Kraft \xC2\xB5m \xC3\xBC\n1,5\n";  // UTF-8

std::string utf16(const std::string& ascii, bool little, bool mark) {
  std::string bytes;
  if (mark) bytes = little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : ascii) {
    bytes += little ? c : '\0';
    bytes += little ? '\0' : c;
  }
  return bytes;
}

TEST(PlainText, EveryEncodingGivesTheSameText) {
  EXPECT_EQ(plain_text(words), words);
  EXPECT_EQ(plain_text("\xEF\xBB\xBF" + words), words);
  EXPECT_EQ(plain_text("Kraft \xB5m \xFC\n1,5\n"), words) << "Latin-1";
  const std::string ascii = "Time,Extension,Load\n1,2,3\n";
  for (const bool little : {false, true})
    for (const bool mark : {false, true}) EXPECT_EQ(plain_text(utf16(ascii, little, mark)), ascii) << little << mark;
  std::string mu = utf16("Kraft ", true, true);
  mu += std::string("\xB5\0m\0", 4);
  EXPECT_EQ(plain_text(mu), "Kraft \xC2\xB5m");
}

TEST(PlainText, TypographicSignsBecomePlainOnes) {
  EXPECT_EQ(plain_text("\xE2\x80\x9Cx\xE2\x80\x9D,\xE2\x80\x9Ey\xE2\x80\x9C,\xC2\xABz\xC2\xBB"), "\"x\",\"y\",\"z\"");
  EXPECT_EQ(plain_text("\x93x\x94"), "\"x\"") << "Windows-1252";
  EXPECT_EQ(plain_text("1\xC2\xA0"
                       "000 \xE2\x88\x92"
                       "5"),
            "1 000 -5");
  EXPECT_EQ(plain_text("\xCE\xBCm"), "\xC2\xB5m");
}

TEST(PlainText, LoneReturnsEndLinesAndZerosStayWhereTheTextIsNone) {
  EXPECT_EQ(plain_text("a\rb\r"), "a\nb\n");
  EXPECT_EQ(plain_text("a\r\nb\r\n"), "a\r\nb\r\n");
  const std::string binary("PK\0\1\2\3\0\0\0\0\5\6\7\0\1\1\1\1", 18);
  EXPECT_NE(plain_text(binary).find('\0'), std::string::npos);
  EXPECT_EQ(plain_text(std::string("\xFF\xFE"
                                   "a",
                                   3)),
            "")
      << "half a character";
}

}  // namespace
}  // namespace weaveform
