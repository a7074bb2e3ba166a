using FractalEngine.Core.Visibility;

namespace FractalEngine.Render;

/// <summary>What a picture took.</summary>
/// <param name="InstanceCount">Copies of meshes that were chosen and drawn.</param>
/// <param name="TriangleCount">Of these copies.</param>
/// <param name="Culling">What was looked at and left out.</param>
/// <param name="MinProjectedSize">
/// Sub-fractals of fewer pixels were drawn as one copy: the setting, or more where the budget asked for it.
/// </param>
/// <param name="CullCount">How often instances were chosen so far: not for pictures that need the same ones as the picture before.</param>
/// <param name="UploadedBytes">Of instances moved to the GPU so far.</param>
/// <param name="CullWaitTime">How long the last choice kept the drawing thread waiting.</param>
/// <param name="Optimisations">What else was not needed.</param>
public readonly record struct FrameStatistics(
    int InstanceCount, long TriangleCount, CullingStatistics Culling, double MinProjectedSize, int CullCount, long UploadedBytes,
    TimeSpan CullWaitTime, OptimisationStatistics Optimisations);
