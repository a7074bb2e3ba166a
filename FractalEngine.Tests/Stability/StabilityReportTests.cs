using FractalEngine.Tests.Support;
using Xunit.Abstractions;

namespace FractalEngine.Tests.Stability;

public class StabilityReportTests(ITestOutputHelper output)
{
    private const string Name = "StabilityReportTests.Save_InAnyOrder_IsOneTableUnderEveryCulture";

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Save_InAnyOrder_IsOneTableUnderEveryCulture(string culture)
    {
        using var folder = new TemporaryFolder();
        var report = InCulture.Run(culture, () => new StabilityReport(output, 1.5));
        report.Require("length, of the size", 0.25, 0.5, () => $"");
        report.Record("angle", 3e-17, at: 10);
        report.Require("angle", 0.125, 4, () => $"", at: 2);
        report.Require("angle", 0.125, 3, () => $"", at: 2);
        report.Record("none", double.NaN);
        report.Record("none", 1);
        InCulture.Run(culture, () =>
        {
            report.Save(folder["new"]);
            return "";
        });
        Assert.Equal(
            $"""
            test,what,at,cases,worst,promised
            {Name}(1.5),angle,,3,0.125,3
            {Name}(1.5),angle,2,2,0.125,3
            {Name}(1.5),angle,10,1,3E-17,
            {Name}(1.5),"length, of the size",,1,0.25,0.5
            {Name}(1.5),none,,2,NaN,

            """,
            string.Join('\n', File.ReadAllText(folder[$"new/{Name}%281.5%29.csv"]).Split('\n')[2..]));
    }

    [Fact]
    public void Save_WhereItCannot_Fails()
    {
        using var folder = new TemporaryFolder();
        var report = new StabilityReport(output);
        Assert.ThrowsAny<IOException>(() => report.Save(folder.Write("file", "")));
        report.Save(folder.Path);
        Assert.EndsWith(
            "a test of this name is there already", Assert.Throws<IOException>(() => report.Save(folder.Path)).Message,
            StringComparison.Ordinal);
    }
}
