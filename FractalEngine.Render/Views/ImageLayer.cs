using FractalEngine.Core.Images;

namespace FractalEngine.Render.Views;

/// <summary>An image that is shown over a frame, below the overlay.</summary>
/// <param name="Image">An image of the size of the frame; its own opacity is ignored.</param>
/// <param name="Opacity">From 0, which shows the frame, to 1, which shows the image. Between, both are mixed in linear light.</param>
public sealed record ImageLayer(PixelImage Image, double Opacity);
