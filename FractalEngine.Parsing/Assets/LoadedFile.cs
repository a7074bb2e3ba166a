using System.Collections.Immutable;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>A loaded file together with all files that it refers to.</summary>
/// <param name="Path">Full path of the file.</param>
/// <param name="Kind">Kind of the file.</param>
/// <param name="Scene">The scene; for a mesh or fractal, a scene of that one object.</param>
/// <param name="ParsedScene">Contents of a scene file with its original lines; null for other kinds.</param>
/// <param name="StorageBytes">Total size of all files read, each counted once, in bytes.</param>
/// <param name="Warnings">Warnings about everything that was ignored.</param>
public sealed record LoadedFile(
    string Path, FileKind Kind, LoadedScene Scene, ParsedScene? ParsedScene, long StorageBytes, ImmutableArray<Diagnostic> Warnings);
