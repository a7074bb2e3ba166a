using Xunit.Sdk;

namespace FractalEngine.Tests.Recorded;

/// <summary>Tests that recorded lines notice what differs, and only that.</summary>
public class RecordedTextTests
{
    [Theory]
    [InlineData("a 3 1.5 2.0E-17 b", true)]
    [InlineData("a 3 1.5000000000001 2.0E-17 b", true)]
    [InlineData("a 3 1.50001 2.0E-17 b", false)]
    [InlineData("a 4 1.5 2.0E-17 b", false)]
    [InlineData("a 3 1.5 3.0E-17 b", false)]
    [InlineData("a 3 1.5 0.0 b", false)]
    [InlineData("a 3 1.5 NaN b", false)]
    [InlineData("a 3 1.5 2.0E-17 c", false)]
    [InlineData("a 3 1.5 2.0E-17", false)]
    public void Check_OfALine_AllowsRoundingOnly(string line, bool isSame)
    {
        if (Environment.GetEnvironmentVariable("REWRITE_RECORDED") is "1")
        {
            return;
        }

        var check = () => RecordedText.Check("sample.txt", [line]);
        if (isSame)
        {
            check();
        }
        else
        {
            Assert.Contains("sample.txt:1", Assert.Throws<XunitException>(check).Message, StringComparison.Ordinal);
        }
    }

    [Theory]
    [InlineData(1, "1.0")]
    [InlineData(0.1, "0.1")]
    [InlineData(1e300, "1E+300")]
    [InlineData(double.NaN, "NaN")]
    public void Text_OfANumber_IsNotAnInteger(double value, string text) => Assert.Equal(text, RecordedText.Text(value));
}
