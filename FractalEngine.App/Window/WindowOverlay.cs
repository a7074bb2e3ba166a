using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>What is written over the picture: keys, progress, errors and passing messages.</summary>
internal sealed class WindowOverlay(RenderWindow window) : IDisposable
{
    public (string Text, double Fraction)? Progress { get; set; }
    public string? Error { get; set; }
    public bool ShowsKeys { get; set; }
    public TimeSpan? NextExpiry { get; private set; }
    public void Describe(LoadedFile file, DrawableScene drawable) { _ = (window, file, drawable); }
    public void Say(string message, TimeSpan now) { _ = (message, now); }
    public bool Expire(TimeSpan now) => now < TimeSpan.Zero;
    public void Draw(FrameRenderer frame) { _ = frame; }
    public void Dispose() { }
}
