using FractalEngine.App.Shell.Reports;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Shell.Reports;

public sealed class SlowWorkNoticeTests
{
    [Fact]
    public void Work_ThatTakesLong_IsToldOnce()
    {
        var text = new StringWriter();
        // It locks itself for each call.
        var output = TextWriter.Synchronized(text);
        using (new SlowWorkNotice("drawing", false, TimeSpan.FromMilliseconds(10), output))
        {
            Polling.WaitUntil(() => Read().Length > 0, "notice");
            Thread.Sleep(TimeSpan.FromMilliseconds(50));
        }

        Assert.Equal("drawing takes more than 0.01 s; Ctrl+C ends it, and leaves no file", Read().TrimEnd());

        string Read()
        {
            lock (output)
            {
                return text.ToString();
            }
        }
    }

    [Theory]
    [InlineData(true, 10)]
    [InlineData(false, 60_000)]
    public void Work_ThatIsQuietOrShort_IsNotTold(bool isQuiet, int milliseconds)
    {
        var output = new StringWriter();
        using (new SlowWorkNotice("drawing", isQuiet, TimeSpan.FromMilliseconds(milliseconds), output))
        {
            Thread.Sleep(TimeSpan.FromMilliseconds(50));
        }

        Assert.Equal("", output.ToString());
    }
}
