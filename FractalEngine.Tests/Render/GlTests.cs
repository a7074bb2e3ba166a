using FractalEngine.Render.Windowing;

namespace FractalEngine.Tests.Render;

/// <summary>
/// The collection of tests that draw. They run one after the other, since a context belongs to one thread at a time, and beside tests that
/// don't draw. Those with a limit of time belong to <see cref="Support.TimedTests"/>.
/// </summary>
[CollectionDefinition(Name)]
public sealed class GlTests
{
    public const string Name = "GL";

    /// <summary>Opens a context, or skips the test where there is no display. A leaked GL object fails the test.</summary>
    public static OffscreenContext OpenContext()
    {
        try
        {
            return new(leak => throw new InvalidOperationException(leak));
        }
        catch (GraphicsUnavailableException exception)
        {
            throw new SkipException(exception.Message);
        }
    }
}
