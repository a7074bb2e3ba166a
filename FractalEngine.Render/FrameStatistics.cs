using FractalEngine.Core.Detail;

namespace FractalEngine.Render;

/// <summary>What a picture took.</summary>
/// <param name="Instances">Copies of meshes that were chosen and drawn.</param>
/// <param name="Triangles">Of these copies.</param>
/// <param name="Cost">What was looked at and left out.</param>
/// <param name="PixelSize">Sub-fractals of fewer pixels were drawn as one copy: the setting, or more where the budget asked for it.</param>
/// <param name="Choices">How often instances were chosen so far: not for pictures that need the same ones as the picture before.</param>
/// <param name="UploadedBytes">Of instances moved to the GPU so far.</param>
/// <param name="WaitedFor">How long the last choice kept the drawing thread waiting.</param>
/// <param name="Skips">What else was not needed.</param>
public readonly record struct FrameStatistics(
    int Instances, long Triangles, DetailCost Cost, double PixelSize, int Choices, long UploadedBytes, TimeSpan WaitedFor, SkipStatistics Skips);
