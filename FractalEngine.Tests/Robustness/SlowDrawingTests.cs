using System.Diagnostics;
using System.Globalization;
using System.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>A signal ends drawing that takes long, such as that of many triangles that fill the frame on a software renderer.</summary>
public sealed class SlowDrawingTests : IDisposable
{
    // Up to a second is usual; a busy machine took three.
    private static readonly TimeSpan MaxDelay = TimeSpan.FromSeconds(5);

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [InlineData("INT", 3)]
    [InlineData("TERM", 6)]
    [InlineData("INT", 12)]
    [Trait("Category", "Soak")]
    public void Render_OfTrianglesThatFillTheFrame_EndsOnASignal(string signal, int seconds)
    {
        Display.Require();
        Signals.Require(signal);
        _folder.Write("stack.obj", CreateStack(300_000));
        using var process = AppProcess.Start(
            _folder.Path, [],
            ["render", "stack.obj", "--look-from", "(0,0,9)", "--look-at", "(0,0,0)", "--no-shadows", "--output", "stack.png"]);
        var error = process.StandardError.ReadToEndAsync();
        // A quick driver may be done already.
        if (!process.WaitForExit(TimeSpan.FromSeconds(seconds)))
        {
            var clock = Stopwatch.StartNew();
            Signals.Send(process, signal);
            Assert.True(process.WaitForExit(Polling.Deadline), error.IsCompleted ? error.Result : "no end");
            Assert.InRange(clock.Elapsed, TimeSpan.Zero, MaxDelay);
            Assert.Equal(130, process.ExitCode);
            Assert.Equal(["stack.obj"], Directory.GetFiles(_folder.Path).Select(Path.GetFileName));
        }
    }

    /// <summary>Triangles behind each other, the farthest first, so that each covers all before it.</summary>
    private static string CreateStack(int count)
    {
        var text = new StringBuilder();
        for (var i = 0; i < count; i++)
        {
            var z = (1e-5 * i).ToString("F5", CultureInfo.InvariantCulture);
            text.Append(CultureInfo.InvariantCulture, $"v -10 -10 {z}\nv 10 -10 {z}\nv 0 10 {z}\nf -3 -2 -1\n");
        }

        return text.ToString();
    }
}
