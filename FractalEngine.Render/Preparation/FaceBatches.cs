using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Preparation;

/// <summary>The faces of a model sorted by material: a batch for each, in the order in which the materials appear.</summary>
internal sealed class FaceBatches
{
    private readonly int[]? _order;

    private FaceBatches(ImmutableArray<DrawableBatch> batches, int[]? order, int emptyFaces) => (Batches, _order, EmptyFaces) = (batches, order, emptyFaces);

    /// <summary>How many faces are drawn.</summary>
    public int FaceCount => Batches.Sum(static batch => batch.IndexCount) / 3;

    /// <summary>How many are not, since they have no area.</summary>
    public int EmptyFaces { get; }

    /// <summary>One for each material; none is empty.</summary>
    public ImmutableArray<DrawableBatch> Batches { get; }

    /// <summary>Whether any face shows a picture.</summary>
    public bool HasTextures => Batches.Any(static batch => batch.Material is { Texture: not null });

    /// <summary>The face that is drawn at a place.</summary>
    /// <param name="place">From 0.</param>
    public int FaceAt(int place) => _order is null ? place : _order[place];

    /// <summary>All faces in one batch, without a material.</summary>
    public static FaceBatches Of(Mesh mesh) => new([new(0, mesh.Faces.Length, null)], null, 0);

    /// <summary>Sorts the faces; those of one material keep their order.</summary>
    /// <param name="model">With its materials.</param>
    /// <param name="textures">Has or decodes their pictures.</param>
    /// <param name="skipsEmpty">Whether faces without area are left out.</param>
    public static FaceBatches Of(Model model, TextureCache textures, bool skipsEmpty)
    {
        var mesh = model.Mesh;
        bool[] isEmpty = skipsEmpty ? [.. Enumerable.Range(0, mesh.FaceCount).Select(face => IsEmpty(mesh, face))] : new bool[mesh.FaceCount];
        var emptyFaces = isEmpty.Count(static empty => empty);
        var hasMaterials = !model.Materials.IsEmpty && !mesh.Groups.IsEmpty;
        if (!hasMaterials && emptyFaces == 0)
        {
            return Of(mesh);
        }

        var (materials, materialOfFace) = hasMaterials ? Assign(model, textures, isEmpty) : ([null], new int[mesh.FaceCount]);
        var starts = new int[materials.Count + 1];
        for (var face = 0; face < materialOfFace.Length; face++)
        {
            if (!isEmpty[face])
            {
                starts[materialOfFace[face] + 1]++;
            }
        }

        for (var i = 1; i < starts.Length; i++)
        {
            starts[i] += starts[i - 1];
        }

        var batches = ImmutableArray.CreateBuilder<DrawableBatch>(materials.Count);
        for (var i = 0; i < materials.Count; i++)
        {
            if (starts[i + 1] > starts[i])
            {
                batches.Add(new(3 * starts[i], 3 * (starts[i + 1] - starts[i]), materials[i]));
            }
        }

        var order = new int[mesh.FaceCount - emptyFaces];
        for (var face = 0; face < materialOfFace.Length; face++)
        {
            if (!isEmpty[face])
            {
                order[starts[materialOfFace[face]]++] = face;
            }
        }

        return new(batches.ToImmutable(), order, emptyFaces);
    }

    private static bool IsEmpty(Mesh mesh, int face)
    {
        var (a, b, c) = mesh.Face(face);
        return EmptyFace.Is(a, b, c);
    }

    /// <summary>The materials that occur, and for each face that is not empty the number of its own among them.</summary>
    private static (List<DrawableMaterial?> Materials, int[] MaterialOfFace) Assign(Model model, TextureCache textures, bool[] isEmpty)
    {
        var mesh = model.Mesh;
        var materials = new List<DrawableMaterial?>();
        var numbers = new Dictionary<(string? Name, bool HasPicture), int>();
        var materialOfFace = new int[mesh.FaceCount];
        foreach (var group in mesh.Groups)
        {
            var given = model.Materials.GetValueOrDefault(group.Material);
            for (var face = group.FirstFace; face < group.FirstFace + group.FaceCount; face++)
            {
                if (isEmpty[face])
                {
                    continue;
                }

                // A face without texture coordinates has no place in a picture.
                var hasPicture = given is { Texture: not null } && HasTextureCoordinates(mesh, face);
                if (!numbers.TryGetValue((given?.Name, hasPicture), out var number))
                {
                    numbers[(given?.Name, hasPicture)] = number = materials.Count;
                    materials.Add(given is null ? null : textures.Of(hasPicture ? given : given with { Texture = null }));
                }

                materialOfFace[face] = number;
            }
        }

        return (materials, materialOfFace);
    }

    private static bool HasTextureCoordinates(Mesh mesh, int face) =>
        mesh.TextureFaces.Length > 0
        && mesh.TextureFaces[3 * face] >= 0 && mesh.TextureFaces[(3 * face) + 1] >= 0 && mesh.TextureFaces[(3 * face) + 2] >= 0;
}
