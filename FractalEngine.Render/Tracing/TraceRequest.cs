using FractalEngine.Core.Scenes;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Tracing;

/// <summary>A view that is to be traced. Equal requests have the same image.</summary>
/// <param name="Scene">The scene, its bodies where they are drawn.</param>
/// <param name="View">Camera and projection.</param>
/// <param name="Width">Width of the image in pixels.</param>
/// <param name="Height">Height of the image in pixels.</param>
public sealed record TraceRequest(LoadedScene Scene, View View, int Width, int Height);
