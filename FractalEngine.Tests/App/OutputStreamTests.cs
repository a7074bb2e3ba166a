using FractalEngine.App.Shell;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests the streams that outputs are written through, which write and do nothing else.</summary>
[Collection(ConsoleTests.Name)]
public sealed class OutputStreamTests
{
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Stream_OfAnOutput_OnlyWrites(bool isStandard)
    {
        using var target = new MemoryStream();
        using var interruption = new InterruptSignal();
        using Stream stream = isStandard
            ? new StandardStream(() => target, static _ => { })
            : new InterruptibleStream(target, interruption.ThrowIfRequested);
        Assert.Equal((false, false, true), (stream.CanRead, stream.CanSeek, stream.CanWrite));
        stream.Write([1, 2, 3, 4, 5], 1, 3);
        stream.Write([6, 7]);
        stream.Flush();
        Assert.Equal((byte[])[2, 3, 4, 6, 7], target.ToArray());
        Assert.Throws<NotSupportedException>(() => stream.Length);
        Assert.Throws<NotSupportedException>(() => stream.Position);
        Assert.Throws<NotSupportedException>(() => { stream.Position = 0; });
        Assert.Throws<NotSupportedException>(() => stream.Read(new byte[1], 0, 1));
        Assert.Throws<NotSupportedException>(() => stream.Seek(0, SeekOrigin.Begin));
        Assert.Throws<NotSupportedException>(() => { stream.SetLength(0); });
    }

    [Fact]
    public void Flush_OfAnInterruptibleStream_FlushesItsTarget()
    {
        using var memory = new MemoryStream();
        using var target = new BufferedStream(memory);
        using var interruption = new InterruptSignal();
        using var stream = new InterruptibleStream(target, interruption.ThrowIfRequested);
        stream.Write([1, 2]);
        Assert.Empty(memory.ToArray());
        stream.Flush();
        Assert.Equal((byte[])[1, 2], memory.ToArray());
    }

    /// <summary>A person at a terminal sees each part at once.</summary>
    [Fact]
    public void Write_OfAStandardStream_OpensItOnceAndFlushesAtOnce()
    {
        int openCount = 0;
        using var memory = new MemoryStream();
        using var target = new BufferedStream(memory);
        using var stream = new StandardStream(
            () =>
            {
                openCount++;
                return target;
            },
            static _ => { });
        Assert.Equal(0, openCount);
        stream.Write([1, 2]);
        Assert.Equal((byte[])[1, 2], memory.ToArray());
        stream.Write([3]);
        Assert.Equal((byte[])[1, 2, 3], memory.ToArray());
        Assert.Equal(1, openCount);
    }

    public static TheoryData<Exception, bool> Failures => new()
    {
        { new IOException("full"), true },
        { new UnauthorizedAccessException("not yours"), true },
        { new ObjectDisposedException("stream"), true },
        { new InvalidOperationException("a mistake"), false },
    };

    [Theory]
    [MemberData(nameof(Failures))]
    public void Write_OfAStandardStreamThatFails_ReportsWhatTheSystemSays(Exception failure, bool isReported)
    {
        Exception? reported = null;
        using var stream = new StandardStream(() => throw failure, exception => reported = exception);
        var thrown = Record.Exception(() => stream.Write([1]));
        Assert.Same(failure, isReported ? reported : thrown);
        Assert.Null(isReported ? thrown : reported);
    }
}
