using System.Collections.Immutable;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>A file and all that it refers to, loaded.</summary>
/// <param name="Path">Full path.</param>
/// <param name="Kind">What it holds.</param>
/// <param name="Scene">The scene; for a mesh or fractal, the scene of that one object.</param>
/// <param name="SceneFile">How a scene file says it; null for other files.</param>
/// <param name="StorageBytes">The size of all files read, each once.</param>
/// <param name="Warnings">What was passed over.</param>
public sealed record LoadedFile(
    string Path, FileKind Kind, LoadedScene Scene, SceneFile? SceneFile, long StorageBytes, ImmutableArray<Diagnostic> Warnings);
