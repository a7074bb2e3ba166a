namespace FractalEngine.Render;

/// <summary>What is left out because it is not needed, apart from what <see cref="FrameStatistics.Culling"/> counts.</summary>
/// <param name="ObjectCount">Of the scene.</param>
/// <param name="BackFaceCulledCount">Of these, drawn without the backs of their faces in the last picture.</param>
/// <param name="ModelCount">The files that the objects show, each once.</param>
/// <param name="PlaceholderCount">Of these, not prepared yet: boxes stand for them.</param>
/// <param name="TextureCount">Pictures on surfaces, each once.</param>
/// <param name="DegenerateTriangleCount">Faces without area that were left out of the models, each model counted once.</param>
/// <param name="Uploads">Of the last picture: buffers moved to the GPU, and those that were there already.</param>
/// <param name="StateChanges">Of the last picture: bindings and uniforms, and those that held already.</param>
public readonly record struct OptimisationStatistics(
    int ObjectCount, int BackFaceCulledCount, int ModelCount, int PlaceholderCount, int TextureCount, long DegenerateTriangleCount,
    RedundancyCounts Uploads, RedundancyCounts StateChanges);
