using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Meshes;

/// <summary>What a material file declares, and what is wrong in it.</summary>
/// <param name="Source">Its text.</param>
/// <param name="Materials">By name; their pictures named as the file does.</param>
/// <param name="TextureNameOffsets">Where the name of each material's picture stands, for messages.</param>
/// <param name="Warnings">At most one, about statements that make no sense.</param>
public sealed record MtlFile(
    SourceText Source,
    ImmutableDictionary<string, Material> Materials,
    ImmutableDictionary<string, int> TextureNameOffsets,
    ImmutableArray<Diagnostic> Warnings);
