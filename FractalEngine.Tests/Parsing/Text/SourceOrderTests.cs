using FractalEngine.Parsing.Text;

namespace FractalEngine.Tests.Parsing.Text;

/// <summary>Tests that places in a text are right in any order, although each search goes on from the last.</summary>
public sealed class SourceOrderTests
{
    [Theory]
    [InlineData("one\ntwo\n\nthree")]
    [InlineData("one\r\ntwo\r\n\r\nthree\r\n")]
    [InlineData("one\rtwo\r\rthree\r")]
    [InlineData("\n\r\r\n")]
    public void Diagnose_InAnyOrder_IsThatOfAFreshText(string text)
    {
        for (int first = 0; first <= text.Length; first++)
        {
            for (int second = 0; second <= text.Length + 1; second++)
            {
                var source = new SourceText("t", text);
                source.Diagnose(first, "m");
                Assert.Equal(new SourceText("t", text).Diagnose(second, "m"), source.Diagnose(second, "m"));
                Assert.Equal(new SourceText("t", text).LineOf(first), source.LineOf(first));
            }
        }
    }
}
