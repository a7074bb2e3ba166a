using FractalEngine.Render.Windowing;

namespace FractalEngine.Tests.Render;

/// <summary>Tests that draw, one after the other: windows and contexts belong to one thread at a time.</summary>
[CollectionDefinition(Name, DisableParallelization = true)]
public sealed class GlTests
{
    public const string Name = "GL";

    /// <summary>A context, or a skipped test where there is no display. Anything that leaks fails the test.</summary>
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
