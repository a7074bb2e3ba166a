using System.Collections.Immutable;
using System.Collections.ObjectModel;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Materials of a parsed material file, with a warning about its faults.</summary>
/// <param name="Source">Text of the file.</param>
/// <param name="Materials">Materials by name; their textures are named as in the file.</param>
/// <param name="TextureNameOffsets">Offset of the texture's name in the text for each material, for messages.</param>
/// <param name="Warnings">
/// At most one about statements that can't be read, one about those that drawn frames do not show, and one about those that none shows.
/// </param>
public sealed record ParsedMtl(
    SourceText Source,
    IReadOnlyDictionary<string, Material> Materials,
    IReadOnlyDictionary<string, int> TextureNameOffsets,
    ImmutableArray<Diagnostic> Warnings)
{
    /// <summary>Offset of the opacity texture's name in the text for each material that has one.</summary>
    public IReadOnlyDictionary<string, int> OpacityTextureNameOffsets { get; init; } = ReadOnlyDictionary<string, int>.Empty;

    /// <summary>Offset of the bump map's name in the text for each material that has one.</summary>
    public IReadOnlyDictionary<string, int> BumpTextureNameOffsets { get; init; } = ReadOnlyDictionary<string, int>.Empty;

    /// <summary>Offset of the normal map's name in the text for each material that has one.</summary>
    public IReadOnlyDictionary<string, int> NormalTextureNameOffsets { get; init; } = ReadOnlyDictionary<string, int>.Empty;
}
