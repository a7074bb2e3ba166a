using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Meshes;

/// <summary>What an OBJ file holds, and what was passed over in it.</summary>
/// <param name="Mesh">Its geometry.</param>
/// <param name="Warnings">At most one about unknown keywords, and one about missing normals or texture coordinates.</param>
public sealed record ObjFile(Mesh Mesh, ImmutableArray<Diagnostic> Warnings)
{
    /// <summary>Where each of the mesh's material files is named, for messages.</summary>
    public ImmutableArray<int> MaterialLibraryOffsets { get; init; } = [];

    /// <summary>Where each material is named first, for messages.</summary>
    public ImmutableDictionary<string, int> MaterialOffsets { get; init; } = ImmutableDictionary<string, int>.Empty;
}
