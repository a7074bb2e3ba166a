using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Mtl;

/// <summary>Materials of a parsed material file, with a warning about its faults.</summary>
/// <param name="Source">Text of the file.</param>
/// <param name="Materials">Materials by name; their textures are named as in the file.</param>
/// <param name="TextureNameOffsets">Offset of each texture's name in the text, for messages. Equal textures differ by their places.</param>
/// <param name="Warnings">
/// At most one about statements that can't be read, one about those that drawn frames do not show, and one about those that none shows.
/// </param>
public sealed record ParsedMtl(
    SourceText Source,
    IReadOnlyDictionary<string, Material> Materials,
    IReadOnlyDictionary<MaterialTexture, int> TextureNameOffsets,
    ImmutableArray<Diagnostic> Warnings);
