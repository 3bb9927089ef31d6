// urdf/urdf.hpp, description.hpp, xml.hpp: files that cannot be read, and texts that are no robot.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <clocale>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <locale>

#include "../fuzz/urdf_input.hpp"
#include "urdf_texts.hpp"

namespace {

using namespace liecheck;
using namespace liecheck::test;

/// A locale whose decimal point is a comma, for C and C++ alike.
struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(Urdf, NumbersHaveADecimalPointInEveryLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"})
    if (std::setlocale(LC_ALL, name)) break;
  const Model<double> m = buildModelFromUrdf(fixture("mixed_joints.urdf"), RootJoint::FreeFlyer);
  std::locale::global(before);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(m.jointPlacements[2].translation(), V3(0.25, 0, 0.1));
  EXPECT_EQ(m.inertias[2].mass(), 1.2);
}

TEST(BadUrdf, AMissingFileADirectoryAndAnEmptyFileAreNamed) {
  const auto said = [](const std::string& path) {
    return refusal<UrdfError>([&] { buildModelFromUrdf(path); });
  };
  EXPECT_EQ(said("/nowhere/robot.urdf"), "/nowhere/robot.urdf: cannot be opened (No such file or directory)");
  const std::string folder = std::filesystem::temp_directory_path().string();
  EXPECT_EQ(said(folder), folder + ": cannot be read (a directory)");
  const std::string path = folder + "/liecheck_empty_" + std::to_string(::getpid()) + ".urdf";
  std::ofstream(path).close();
  EXPECT_EQ(said(path), path + ":1: empty (0 bytes)");
  std::filesystem::remove(path);
  expectRefused(" \n\t\n", 1, "empty", "4 bytes");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(said(path), path + ": cannot be read (a pipe without a writer)");
  std::filesystem::remove(path);
  EXPECT_EQ(said("/dev/null"), "/dev/null: cannot be read (neither a regular file nor a pipe)");
  std::ofstream(path).close();
  std::filesystem::resize_file(path, max_urdf_bytes + 1);
  EXPECT_EQ(said(path), path + ": larger than the limit for a URDF (67108864 bytes)");
  std::filesystem::remove(path);
}

TEST(BadUrdf, CutOffOrMalformedTextIsRefused) {
  const std::string whole = twoLinks("fixed", "");
  EXPECT_NO_THROW(buildModelFromUrdfText(whole));
  for (std::size_t size = 1; size + 9 < whole.size(); ++size) refusal(whole.substr(0, size));
  expectRefused("<robot name='r'>\n<link name='a'>\n</robot>", 2, "malformed XML",
                "an element without a closing tag of its name");
  expectRefused("<robot name='r'>\n<link name='a' name='b'/></robot>", 2, "malformed XML",
                "duplicate attribute: name='b'/></robot>");
  EXPECT_TRUE(has(refusal("<robot name='r'>\n<link name=a/></robot>"), "malformed"));
  refusal("not XML at all");
  expectRefused(std::string("<robot name='r'>\n<link name='a'/>\0</robot>", 43), 2, "zero byte", "byte 33");
  expectRefused("<robot name='r'><link name='a'/></robot>\n<robot name='s'/>", 2, "a second root element",
                "<robot name='s'/>");
  expectRefused("<robot name='r'><link name='a'/></robot>\nand more", 2, "text outside the root element",
                "and more");
}

TEST(Urdf, VisualAndGazeboElementsAreNotRead) {
  EXPECT_EQ(buildModelFromUrdfText(
                "<robot name='r'><link name='a'><visual><material name='none'/></visual><inertial>"
                "<mass value='2'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
                "</inertial></link><gazebo><link/></gazebo></robot>",
                RootJoint::FreeFlyer)
                .inertias[1]
                .mass(),
            2);
}

TEST(BadUrdf, SomethingThatIsNoRobotIsRefused) {
  expectRefused("\n<sdf name='r'/>", 2, "expected <robot>", "sdf");
  expectRefused("<!-- nothing -->", 1, "no element", "");
  expectWarned("<robot><link name='a'/></robot>", 1, "a robot without a name is named", "unnamed");
  expectRefused("<robot name='r'>\n</robot>", 1, "a robot without links", "r");
  expectRefused("<robot name='r' version='2.0'><link name='a'/></robot>", 1, "a URDF version other than 1.0",
                "2.0");
  expectRefused("<robot name='r'>\n<link/></robot>", 2, "a link without a name", "");
}

TEST(BadUrdf, TooDeepNestingIsRefusedBeforeAnyParserRecurses) {
  std::string deep = "<robot name='r'>\n<link name='a'>\n";
  for (int i = 0; i < 1000000; ++i) deep += "<x>";
  expectRefused(deep, 3, "nested too deep", "more than 64");
}

/// What takes quadratic time at this size takes minutes; all of it together takes about a second.
TEST(BadUrdf, AHundredThousandAttributesReferencesOrElementsTakeLinearTime) {
  constexpr int n = 100000;
  std::string attributes, words, references, doctypes, parts;
  for (int i = 0; i < n; ++i) {
    const std::string number = std::to_string(i);
    attributes += " x" + number + "=''";
    words += "<x" + number + "/>";
    references += "&#";
    doctypes += "<!DOCTYPE robot>\n";
    parts += "<link name='l" + number + "'/><joint name='j" + number +
             "' type='fixed'><parent link='a'/><child link='l" + number + "'/></joint>\n";
  }
  const std::string open = "<robot name='r'>\n<link name='a'", close = "</link></robot>";
  const std::clock_t start = std::clock();
  EXPECT_EQ(loadUrdfText(open + attributes + ">" + close).warnings.size(), std::size_t(n));
  EXPECT_NO_THROW(loadUrdfText(open + ">\n<visual name='" + references + "'/>" + close));
  EXPECT_NO_THROW(loadUrdfText(open + ">\n" + references + close));
  expectRefused(doctypes + "<sdf/>", 2, "malformed XML", "syntax error: <!DOCTYPE robot>");
  EXPECT_EQ(loadUrdfText(open + ">" + words + close).warnings.size(), std::size_t(n));
  EXPECT_EQ(buildModelFromUrdfText(open + "/>" + parts + "</robot>").nframes, 2 + 2 * n);
  EXPECT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, 20) << "s of processor time: not linear";
}

TEST(BadUrdf, APipeIsReadOnce) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string text = twoLinks("fixed", "");
  ASSERT_EQ(::write(ends[1], text.data(), text.size()), ssize_t(text.size()));
  ::close(ends[1]);
  EXPECT_EQ(readUrdf("/proc/self/fd/" + std::to_string(ends[0])), text);
  ::close(ends[0]);
}

TEST(BadUrdf, TextThatIsNotUtf8IsRefusedWithItsLine) {
  for (const char* bad : {"\xff", "\x80", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"})
    EXPECT_TRUE(refusal("<robot name='r'>\n<link name='" + std::string(bad) + "'/></robot>")
                    .starts_with("bad.urdf:2: not UTF-8"));
  EXPECT_NO_THROW(
      buildModelFromUrdfText("<robot name='\xc3\xa9\xe2\x82\xac\xf0\x9f\xa4\x96'><link name='a'/></robot>"));
}

TEST(BadUrdf, UnmatchedClosingTagsAndEntitiesAreRefused) {
  const std::string robot = "<robot name='r'>\n<link name='a'/></robot>\n";
  expectRefused(robot + "</robot></robot>", 3, "malformed XML",
                "not well-formed (invalid token): /robot></robot>");
  expectRefused("</robot>" + robot, 1, "malformed XML",
                "not well-formed (invalid token): /robot><robot name='r'>");
  expectRefused("<!DOCTYPE robot [<!ENTITY x 'y'>]>\n" + robot, 1, "(entities) is not supported",
                "[<!ENTITY x 'y'");
  expectRefused("<!DOCTYPE robot SYSTEM 'robot.dtd'>\n" + robot, 1, "(entities) is not supported",
                "robot.dtd");
  EXPECT_NO_THROW(buildModelFromUrdfText("<!DOCTYPE robot>\n" + robot));
}

TEST(Urdf, WhatOtherReadersTakeBesideXmlIsRead) {
  for (const std::string part :
       {"<!-- ------ links ------ -->", "<!-- a -- b -->", "<!--- a --->", "& &foo; ]]> \x01 text",
        "<![CDATA[ \x01 ]]>", "<!-- <link name='b'/> & -->"})
    EXPECT_EQ(buildModelFromUrdfText("<robot name='r'>" + part + "<link name='a'/></robot>" +
                                     (part.front() == '<' && part[2] == '-' ? part : ""))
                  .nframes,
              2)
        << part;
  EXPECT_EQ(
      buildModelFromUrdfText("<robot name='a&b &r; &lt;&#65;&#x20AC;&#;'>\n<link name='a'/></robot>").name,
      "a&b &r; <A\xe2\x82\xac&#;");
  EXPECT_TRUE(refusal("<robot name='r'><!-- a\n-- b\n--><link/></robot>").starts_with("bad.urdf:3: "));
}

TEST(BadUrdf, AMessageIsOneShortLine) {
  const std::string said = refusal(twoLinks(std::string(1000, 'x'), ""));
  EXPECT_LT(said.size(), 160U) << said;
  EXPECT_TRUE(has(refusal("<robot name='r'>\n<link name='a'/></robot>\nsome\nmore"), "(some more)"));
}

TEST(Urdf, NamesAreReadWhateverEncodingIsDeclaredAndReferencesAreReplaced) {
  for (const std::string before : {"", "\xef\xbb\xbf", "\xef\xbb\xbf \r\n\t", "<!-- \xc3\xa9 -->",
                                   "<?other target?>", "<!DOCTYPE robot>"})
    for (const std::string encoding :
         {"", " encoding='ISO-8859-1'", " encoding='UTF-16'", " encoding='klingon'"}) {
      const bool first = before.find('<') == before.npos;
      const std::string declaration = first ? "<?xml version='1.0'" + encoding + "?>" : "";
      EXPECT_EQ(buildModelFromUrdfText(before + declaration +
                                       "<robot name='\xc3\xa9&lt;&amp;&#65;&#x20AC;'><link name='a'/>"
                                       "<![CDATA[<link/>]]></robot><!-- after -->")
                    .name,
                "\xc3\xa9<&A\xe2\x82\xac");
    }
}

TEST(BadUrdf, AnAttributeIsNamedWithItsOwnLine) {
  const std::string text =
      "\n<?xml version='1.0'?>\r\n<robot\r\n name = \"r>'\n'\" foo='1'\n bar\n='2'>\n<link "
      "name='a'/></robot>";
  const std::vector<std::string> warnings = loadUrdfText(text).warnings;
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TRUE(warnings[0].starts_with("URDF text:5: ")) << warnings[0];
  EXPECT_TRUE(warnings[1].starts_with("URDF text:6: ")) << warnings[1];
  EXPECT_EQ(buildModelFromUrdfText("<robot name='r\t\ns'><link name='a'/></robot>").name, "r\t\ns");
}

// The seeds and the findings of the fuzzer. Each is a usable robot, or is refused with one short line.
TEST(BadUrdf, TheCorpusOfTheFuzzerIsReadOrRefused) {
  int robots = 0, texts = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(LIECHECK_FIXTURES) + "/urdf_fuzz")) {
    if (entry.path().extension() != ".urdf") continue;
    SCOPED_TRACE(entry.path());
    ++texts;
    EXPECT_NO_THROW(robots += try_urdf(readUrdf(entry.path())));
  }
  EXPECT_GE(robots, 6);
  EXPECT_GE(texts - robots, 2);
}
TEST(Urdf, AnErrorStaysShortAndKeepsBothEndsIfANameIsLong) {
  std::string name;
  for (int i = 0; i < 500; ++i) name += "\xc3\xa4";  // an a with two dots
  for (const std::string before :
       {"link '", "a link '"}) {  // a character begins at an even and at an odd byte
    const std::string what = UrdfError("f", 3, before + name + "' has a negative mass", "-1").what();
    EXPECT_LE(what.size(), 420u);
    EXPECT_TRUE(what.starts_with("f:3: " + before + "\xc3\xa4")) << what;
    EXPECT_TRUE(has(what, "\xc3\xa4...\xc3\xa4"));
    EXPECT_TRUE(has(what, "\xc3\xa4' has a negative mass (-1)"));
  }
}

}  // namespace
