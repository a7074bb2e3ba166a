using FractalEngine.Render.Gl;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Tests.Render;

/// <summary>
/// The context in which the tests of a thread draw one after the other, so that programs are compiled once. A GL object that a test leaves
/// behind fails it. What tests of contexts themselves need is <see cref="GlTests.OpenContext"/>.
/// </summary>
internal sealed class SharedContext : IDisposable
{
    [ThreadStatic]
    private static OffscreenContext? _ofThread;

    private readonly OffscreenContext _context = _ofThread ??= GlTests.OpenContext();

    /// <summary>Makes the context current, or skips the test where there is no display.</summary>
    public SharedContext() => _context.MakeCurrent();

    public GlResources Resources => _context.Resources;

    public static implicit operator OffscreenContext(SharedContext shared) => shared._context;

    public void Dispose()
    {
        // Also makes it current, where a test has drawn elsewhere meanwhile.
        _context.MakeCurrent();
        Assert.Empty(_context.Resources.DeleteAll());
    }
}
