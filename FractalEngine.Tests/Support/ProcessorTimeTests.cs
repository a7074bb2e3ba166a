using Xunit.Sdk;

namespace FractalEngine.Tests.Support;

public class ProcessorTimeTests
{
    private static readonly TimeSpan Work = TimeSpan.FromSeconds(0.2);

    [SkippableFact]
    public void OfThread_WhileAnotherThreadWorks_CountsOnlyItsOwn()
    {
        Elsewhere.SkipIf(!OperatingSystem.IsLinux(), "there is no count for one thread");
        var before = ProcessorTime.OfThread;
        var thread = new Thread(Spin);
        thread.Start();
        thread.Join();
        Assert.InRange(ProcessorTime.OfThread - before, TimeSpan.Zero, Work / 4);
    }

    [Fact]
    public void RunWithin_OfWorkBeyondTheLimit_Fails() =>
        Assert.Throws<XunitException>(() => ProcessorTime.RunWithin(Work.TotalSeconds / 4, Spin));

    private static void Spin()
    {
        for (var start = ProcessorTime.OfThread; ProcessorTime.OfThread - start < Work;)
        {
        }
    }
}
