namespace FractalEngine.Render;

/// <summary>What is left out because it is not needed, apart from what <see cref="FrameStatistics.Cost"/> counts.</summary>
/// <param name="Objects">Of the scene.</param>
/// <param name="OneSided">Of these, drawn without the backs of their faces in the last picture.</param>
/// <param name="Models">The files that the objects show, each once.</param>
/// <param name="Unprepared">Of these, not prepared yet: boxes stand for them.</param>
/// <param name="Textures">Pictures on surfaces, each once.</param>
/// <param name="EmptyFaces">Faces without area that were left out of the models, each model counted once.</param>
/// <param name="Uploads">Of the last picture: buffers moved to the GPU, and those that were there already.</param>
/// <param name="StateChanges">Of the last picture: bindings and uniforms, and those that held already.</param>
public readonly record struct SkipStatistics(
    int Objects, int OneSided, int Models, int Unprepared, int Textures, long EmptyFaces, ChangeCounts Uploads, ChangeCounts StateChanges);
