using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Mtl;

namespace FractalEngine.Parsing.Exports;

/// <summary>Makes a scene of one mesh out of all that a scene shows, for formats that want one closed surface.</summary>
/// <remarks>
/// Positions, faces and colours are kept, those of vertices excepted, and so are camera and lights. Memory: some 100 bytes a face, and
/// 300 more to weld.
/// </remarks>
public sealed class JoinedScene
{
    // Of the diagonal: what coincides differs by the rounding of coordinates.
    private const double RelativeTolerance = 1e-9;

    // A diagonal may be too small to be multiplied, or too large for a number.
    private const double MinTolerance = double.Epsilon;
    private const double MaxTolerance = RelativeTolerance * double.MaxValue;

    private readonly List<double> _positions = [];
    private readonly List<int> _indices = [];
    private readonly List<int> _sides = [];
    private readonly List<MeshGroup> _groups = [];
    private readonly SceneMaterials _materials;

    private JoinedScene(LoadedScene scene) => _materials = SceneMaterials.Of(scene);

    /// <summary>Joins all instances of a scene.</summary>
    /// <param name="scene">Scene whose fractals are finite, unless the settings say how many instances there may be.</param>
    /// <param name="settings">The limits.</param>
    /// <param name="isWelded">Whether vertices that coincide are joined and walls between solids go, see <see cref="MeshWelding"/>.</param>
    /// <exception cref="FractalLimitException">The scene has more faces than allowed, or than one mesh can hold.</exception>
    public static LoadedScene Of(LoadedScene scene, ExportSettings settings, bool isWelded)
    {
        var exported = ExportedScene.Of(scene, settings, AffineMap.Identity);
        if (exported.Parts.Sum(static part => part.Count * Math.Max(part.Mesh.Positions.Length, part.Mesh.VertexIndices.Length))
            > Array.MaxLength)
        {
            throw new FractalLimitException($"{exported.Contents} are more than one mesh can hold");
        }

        var joined = new JoinedScene(scene);
        foreach (var part in exported.Parts)
        {
            joined.Add(part);
        }

        var mesh = new Mesh([.. joined._positions], [.. joined._indices]).WithGroups([.. joined._groups], []);
        if (isWelded && mesh.FaceCount > 0 && mesh.UsedBounds.Diagonal is > 0 and var size)
        {
            mesh = MeshWelding.Weld(
                mesh, [.. joined._sides], Math.Clamp(RelativeTolerance * size, MinTolerance, MaxTolerance), settings.Progress);
        }

        var model = new MeshModel(mesh)
        {
            Materials = joined._materials.ByName.ToImmutableDictionary(
                static pair => pair.Key, static pair => pair.Value.WithoutImages()),
        };
        return LoadedScene.Of(scene.Scene with
        {
            Objects = [new(model) { Name = scene.Objects.Length == 1 ? exported.Parts[0].ObjectName : "scene" }],
        });
    }

    /// <summary>Tells what joining loses of a scene, a sentence each.</summary>
    public static ImmutableArray<string> LossesOf(LoadedScene scene) =>
    [
        .. ExportedScene.LossesOf(scene),
        .. scene.Models.SelectMany(static model => model.Parts).Any(static part => !part.Mesh.Colours.IsEmpty)
            ? (string[])["colours of vertices are not written"] : [],
    ];

    /// <summary>Tells what welding has left, such as "closed, 24 edges where surfaces touch".</summary>
    public static string Describe(LoadedScene welded)
    {
        ArgumentNullException.ThrowIfNull(welded);
        var (open, touching, first) = SurfaceEdges.Of(welded.Objects[0].Model.Mesh);
        var closed = open == 0 ? "closed" : $"{Edges(open, "open ")}, one at {first}";
        return touching == 0 ? closed : $"{closed}, {Edges(touching, "")} where surfaces touch";

        static string Edges(int count, string kind) => FormattableString.Invariant($"{count} {kind}edge{(count == 1 ? "" : "s")}");
    }

    private void Add(ExportedPart part)
    {
        var (mesh, sides) = (part.Mesh, MeshWelding.FindSides(part.Mesh));
        foreach (var instance in part.Instances)
        {
            var (firstVertex, firstFace) = (_positions.Count / 3, _indices.Count / 3);
            for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
            {
                var (x, y, z) = instance.Map * mesh.Vertex(vertex);
                _positions.AddRange([x, y, z]);
            }

            // A mirror turns faces inside out; exchanging two corners turns them back.
            var (second, third) = instance.Map.Linear.Determinant() < 0 ? (2, 1) : (1, 2);
            for (var i = 0; i < mesh.VertexIndices.Length; i += 3)
            {
                _indices.Add(firstVertex + mesh.VertexIndices[i]);
                _indices.Add(firstVertex + mesh.VertexIndices[i + second]);
                _indices.Add(firstVertex + mesh.VertexIndices[i + third]);
                _sides.Add(firstFace + sides[i / 3]);
            }

            foreach (var group in part.Groups)
            {
                AddGroup(firstFace + group.FirstFace, group.FaceCount, part.MaterialOf(_materials, group.Material, instance.Tint));
            }
        }
    }

    private void AddGroup(int firstFace, int faceCount, string material)
    {
        if (_groups is [.., var last] && last.Material == material)
        {
            _groups[^1] = last with { FaceCount = last.FaceCount + faceCount };
            return;
        }

        _groups.Add(new(firstFace, faceCount, "", "", material, 0));
    }
}
