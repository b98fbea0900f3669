#include "support/picture_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/internal/plot/gnuplot.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using test::faults_of;
using test::SvgPicture;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The picture that gnuplot makes of the commands. A frame from (200, 130) to (1200, 1170) is set, with
/// x from 0 to 10 and y from 0 to 1.
SvgPicture drawn(const std::string& commands) {
    const test::TemporaryFolder folder;
    draw_picture(
        folder / "picture.svg",
        "set lmargin at screen 0.1; set rmargin at screen 0.6; set bmargin at screen 0.1; set tmargin "
        "at screen 0.9\nset xrange [0:10]; set yrange [0:1]; set xtics 2; set ytics 0.2\n" +
            commands + "\nset output\n");
    return test::read_svg(folder / "picture.svg");
}

std::vector<std::string> faults_in(const std::string& commands) {
    return faults_of(drawn(commands));
}

TEST(TextExtent, IsThatOfTheFont) {
    // DejaVu Sans: figures are 1303 of 2048 wide, and as high as a capital letter, 1493 of 2048.
    const test::TextExtent one = test::text_extent("8", 2048.0, false);
    EXPECT_DOUBLE_EQ(one.width, 1303.0);
    EXPECT_NEAR(one.ink.sizes().y(), 1493.0, 60.0);
    EXPECT_DOUBLE_EQ(test::text_extent("88", 20.48, false).width, 26.06);
    EXPECT_GT(test::text_extent("8", 20.0, true).width, test::text_extent("8", 20.0, false).width);
    EXPECT_DOUBLE_EQ(test::text_extent("−", 1.0, false).width, test::text_extent("+", 1.0, false).width);
    EXPECT_TRUE(test::text_extent("  ", 20.0, false).ink.isEmpty());
}

TEST(SvgPicture, HoldsTheFrameTheTextsAndWhatEachCurveShows) {
    const SvgPicture picture = drawn(
        "set label 'over it' at screen 0.35,0.95 center\n"
        "plot 0.5+0.3*sin(x) with lines title 'a wave', '+' using (5):(0.5) every ::0::0 with points title "
        "'dot'");
    EXPECT_EQ(picture.canvas.sizes(), Eigen::Vector2d(2000.0, 1300.0));
    ASSERT_EQ(picture.panels.size(), 1U);
    EXPECT_TRUE(picture.panels[0].isApprox(
        test::PixelBox(Eigen::Vector2d(200.0, 130.0), Eigen::Vector2d(1200.0, 1170.0)), 1e-4));
    ASSERT_EQ(picture.curves.size(), 2U);
    EXPECT_EQ(picture.curves[0].title, "a wave");
    ASSERT_EQ(picture.curves[0].lines.size(), 1U);
    EXPECT_EQ(picture.curves[0].lines[0].size(), 100U);
    EXPECT_EQ(picture.curves[0].panel, 0U);
    ASSERT_EQ(picture.curves[1].marks.size(), 1U);
    EXPECT_NEAR(picture.curves[1].marks[0].x(), 700.0, 0.1);
    EXPECT_NEAR(picture.curves[1].marks[0].y(), 650.0, 0.1);
    const auto over = std::find_if(picture.texts.begin(), picture.texts.end(),
                                   [](const test::SvgText& text) { return text.words == "over it"; });
    ASSERT_NE(over, picture.texts.end());
    EXPECT_NEAR(over->box.center().x(), 700.0, 2.0);
    EXPECT_NEAR(over->box.center().y(), 65.0, 8.0);
}

TEST(SvgPicture, DoesNotTakeTheKeysSamplesForDataWhereverTheKeyStands) {
    for (const char* place : {"inside top right", "at screen 0.8,0.5", "at screen 0.3,0.03 Left reverse"}) {
        const SvgPicture picture =
            drawn(std::string("set key ") + place +
                  "\nplot '+' using 1:(0.05*$1) every 25 with linespoints title 'rising'");
        ASSERT_EQ(picture.curves.size(), 1U);
        EXPECT_EQ(picture.curves[0].marks.size(), 4U) << place;
        ASSERT_EQ(picture.curves[0].lines.size(), 1U) << place;
        EXPECT_EQ(picture.curves[0].lines[0].size(), 4U) << place;
        EXPECT_THAT(faults_of(picture), IsEmpty()) << place;
    }
}

TEST(PictureFaults, NoneInAPictureAsItShouldBe) {
    EXPECT_THAT(
        faults_in("set label 'over it' at screen 0.35,0.95 center\nset ylabel 'turned' \n"
                  "plot 0.5+0.3*sin(x) with lines, '+' using 1:(0.09*$1+0.05) every 10 with linespoints"),
        IsEmpty());
}

TEST(PictureFaults, OverlappingTexts) {
    EXPECT_THAT(
        faults_in("set label 'first' at screen 0.8,0.5\nset label 'second' at screen 0.81,0.505\nplot 0.5"),
        ElementsAre("the texts 'first' and 'second' overlap"));
    EXPECT_THAT(faults_in("set xtics 0.2\nplot 0.5"), Contains(HasSubstr("overlap")));
}

TEST(PictureFaults, TextsBeyondThePictureOrAcrossAFrame) {
    EXPECT_THAT(faults_in("set label 'much too far right' at screen 0.95,0.5\nplot 0.5"),
                ElementsAre("the text 'much too far right' leaves the picture"));
    EXPECT_THAT(faults_in("set label 'over the edge' at screen 0.55,0.5\nplot 0.2"),
                ElementsAre("the text 'over the edge' lies across the frame of the panel at (200, 130)"));
    EXPECT_THAT(faults_in("set label 'turned upright' at screen 0.02,0.05 center rotate\nplot 0.5"),
                ElementsAre("the text 'turned upright' leaves the picture"));
}

TEST(PictureFaults, TextsUnderPoints) {
    EXPECT_THAT(
        faults_in("set label 'hidden' at 5,0.5 center\nplot '+' using 1:(0.5) with points title 'dots'"),
        Contains("a point of 'dots' lies on the text 'hidden'"));
}

TEST(PictureFaults, CurvesThatAreCutOff) {
    const auto cut = Contains(HasSubstr("is cut off at the frame of the panel at (200, 130)"));
    EXPECT_THAT(faults_in("plot 1.5*abs(sin(x)) with lines"), cut);             // again and again
    EXPECT_THAT(faults_in("set yrange [0:0.97]\nplot 0.2*x with lines"), cut);  // beside the last number
    EXPECT_THAT(faults_in("plot '+' using 1:(0.2*$1) every 10 with linespoints"), cut);  // between points
    EXPECT_THAT(faults_in("plot '-' with filledcurves closed\n1 0.5\n2 0.5\n1.5 1.5\ne"), cut);
    // 0 to 100 % and back is all that there is.
    EXPECT_THAT(faults_in("plot 0.1*x with lines"), IsEmpty());
}

TEST(PictureFaults, CurvesThatLeaveTheirFrame) {
    // gnuplot itself cuts lines off; what it does not cut has to be moved by hand.
    SvgPicture picture = drawn("plot 0.5+0.1*x*0.1 with lines title 'moved'");
    for (Eigen::Vector2d& place : picture.curves[0].lines[0]) place.x() += 500.0;
    EXPECT_THAT(faults_of(picture), ElementsAre("'moved' leaves the panel at (200, 130)"));
}

TEST(PictureFaults, PanelsWithoutACurve) {
    const auto empty = ElementsAre("the panel at (200, 130) shows no curve");
    EXPECT_THAT(faults_in("plot 3 with lines"), empty);
    EXPECT_THAT(faults_in("plot '-' with lines\n5 0.5\ne"), empty);
    EXPECT_THAT(faults_in("plot NaN with lines"), empty);
}

TEST(PictureFaults, AxesWithOneNumber) {
    EXPECT_THAT(faults_in("set xtics 20\nplot 0.5"),
                ElementsAre("the panel at (200, 130) has one number below it"));
    EXPECT_THAT(faults_in("set yrange [0.1:0.9]\nset ytics 0.5\nplot 0.5"),
                ElementsAre("the panel at (200, 130) has one number beside it"));
    EXPECT_THAT(faults_in("set format x ''\nplot 0.5"), IsEmpty());  // that of the panel below serves it too
}

TEST(PictureFaults, NumbersThatAreNone) {
    EXPECT_THAT(
        faults_in(
            "set label 'mean nan m/s' at screen 0.8,0.5\nset label 'nancy' at screen 0.8,0.6\nplot 0.5"),
        ElementsAre("the text 'mean nan m/s' holds no number"));
    const test::TemporaryFolder folder;
    const auto file = folder.file("bad.svg",
                                  "<svg width='100' height='100'><g id='gnuplot_plot_1'><path d='M1,2 Lnan,3 "
                                  "L4,inf'/></g></svg>");
    EXPECT_THAT(faults_of(test::read_svg(file)),
                ElementsAre("'nan' is no finite number", "'inf' is no finite number"));
}

}  // namespace
}  // namespace samara
