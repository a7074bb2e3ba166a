using System.Collections.Immutable;
using System.Collections.ObjectModel;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Contents of a parsed mesh file of any format, with warnings about what was ignored.</summary>
/// <param name="Mesh">Geometry, groups and names of material files.</param>
/// <param name="Warnings">
/// At most one about unknown keywords, one about normals or texture coordinates that don't exist, and one about faces that are too short.
/// </param>
public sealed record ParsedObj(Mesh Mesh, ImmutableArray<Diagnostic> Warnings)
{
    /// <summary>Positions of the names of the mesh's material files, for messages.</summary>
    public ImmutableArray<SourcePosition> MaterialLibraryPositions { get; init; } = [];

    /// <summary>Position of the first use of each material, for messages.</summary>
    public IReadOnlyDictionary<string, SourcePosition> MaterialPositions { get; init; } =
        ReadOnlyDictionary<string, SourcePosition>.Empty;

    /// <summary>The materials of the file itself; null where they are those of other files.</summary>
    public IReadOnlyDictionary<string, Material>? Materials { get; init; }

    /// <summary>
    /// Meshes that stand at several places, beside <see cref="Mesh"/>, each with its name in the file and with its places; empty where the
    /// format has none, or all is one mesh.
    /// </summary>
    public ImmutableArray<(Mesh Mesh, string Name, TransformationSet Places)> Instances { get; init; } = [];

    /// <summary>Camera and lights of the file, in a scene without objects; null for none.</summary>
    public Scene? Surroundings { get; init; }

    /// <summary>Size of the file that was read, in bytes; 0 for a text that comes from no file.</summary>
    public long ByteCount { get; init; }
}
