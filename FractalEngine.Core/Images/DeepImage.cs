namespace FractalEngine.Core.Images;

/// <summary>An image as plain data: sRGB, 16 bits a component.</summary>
/// <param name="Width">Width of the image in pixels.</param>
/// <param name="Height">Height of the image in pixels.</param>
/// <param name="Pixels">Components of all pixels: red, green, blue, alpha; the top row first; [height × width × 4].</param>
public sealed record DeepImage(int Width, int Height, ushort[] Pixels);
