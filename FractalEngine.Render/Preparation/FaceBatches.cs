using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Preparation;

/// <summary>The faces of a model sorted by material: a batch for each, in the order in which the materials appear.</summary>
internal sealed class FaceBatches
{
    private readonly int[]? _faceOrder;

    private FaceBatches(ImmutableArray<DrawableBatch> batches, int[]? faceOrder, int degenerateTriangleCount) =>
        (Batches, _faceOrder, DegenerateTriangleCount) = (batches, faceOrder, degenerateTriangleCount);

    /// <summary>How many faces are drawn.</summary>
    public int FaceCount => Batches.Sum(static batch => batch.IndexCount) / 3;

    /// <summary>How many are not, since they have no area.</summary>
    public int DegenerateTriangleCount { get; }

    /// <summary>One for each material; none is empty.</summary>
    public ImmutableArray<DrawableBatch> Batches { get; }

    /// <summary>Whether any face shows a picture.</summary>
    public bool HasTextures => Batches.Any(static batch => batch.Material is { Texture: not null });

    /// <summary>The face that is drawn at a place.</summary>
    /// <param name="drawIndex">From 0.</param>
    public int FaceAt(int drawIndex) => _faceOrder is null ? drawIndex : _faceOrder[drawIndex];

    /// <summary>All faces in one batch, without a material.</summary>
    public static FaceBatches Of(Mesh mesh) => new([new(0, mesh.VertexIndices.Length, null)], null, 0);

    /// <summary>Sorts the faces; those of one material keep their order.</summary>
    /// <param name="model">With its materials.</param>
    /// <param name="textures">Has or decodes their pictures.</param>
    /// <param name="removeDegenerate">Whether faces without area are left out.</param>
    public static FaceBatches Of(Model model, TextureCache textures, bool removeDegenerate)
    {
        var mesh = model.Mesh;
        bool[] isDegenerate = removeDegenerate
            ? [.. Enumerable.Range(0, mesh.FaceCount).Select(face => IsDegenerate(mesh, face))]
            : new bool[mesh.FaceCount];
        var degenerateCount = isDegenerate.Count(static degenerate => degenerate);
        var hasMaterials = !model.Materials.IsEmpty && !mesh.Groups.IsEmpty;
        if (!hasMaterials && degenerateCount == 0)
        {
            return Of(mesh);
        }

        var (materials, materialOfFace) = hasMaterials ? AssignMaterials(model, textures, isDegenerate) : ([null], new int[mesh.FaceCount]);
        var starts = new int[materials.Count + 1];
        for (var face = 0; face < materialOfFace.Length; face++)
        {
            if (!isDegenerate[face])
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

        var faceOrder = new int[mesh.FaceCount - degenerateCount];
        for (var face = 0; face < materialOfFace.Length; face++)
        {
            if (!isDegenerate[face])
            {
                faceOrder[starts[materialOfFace[face]]++] = face;
            }
        }

        return new(batches.ToImmutable(), faceOrder, degenerateCount);
    }

    private static bool IsDegenerate(Mesh mesh, int face)
    {
        var (a, b, c) = mesh.Face(face);
        return DegenerateTriangle.Test(a, b, c);
    }

    /// <summary>The materials that occur, and for each face that is not empty the number of its own among them.</summary>
    private static (List<DrawableMaterial?> Materials, int[] MaterialOfFace) AssignMaterials(Model model, TextureCache textures,
        bool[] isDegenerate)
    {
        var mesh = model.Mesh;
        var materials = new List<DrawableMaterial?>();
        var materialIndices = new Dictionary<(string? Name, bool HasPicture), int>();
        var materialOfFace = new int[mesh.FaceCount];
        foreach (var group in mesh.Groups)
        {
            var fileMaterial = model.Materials.GetValueOrDefault(group.Material);
            for (var face = group.FirstFace; face < group.FirstFace + group.FaceCount; face++)
            {
                if (isDegenerate[face])
                {
                    continue;
                }

                // A face without texture coordinates has no place in a picture.
                var hasTexture = fileMaterial is { Texture: not null } && HasTextureCoordinates(mesh, face);
                if (!materialIndices.TryGetValue((fileMaterial?.Name, hasTexture), out var materialIndex))
                {
                    materialIndices[(fileMaterial?.Name, hasTexture)] = materialIndex = materials.Count;
                    materials.Add(fileMaterial is null
                        ? null
                        : textures.GetMaterial(hasTexture ? fileMaterial : fileMaterial with { Texture = null }));
                }

                materialOfFace[face] = materialIndex;
            }
        }

        return (materials, materialOfFace);
    }

    private static bool HasTextureCoordinates(Mesh mesh, int face) =>
        mesh.TextureIndices.Length > 0
        && mesh.TextureIndices[3 * face] >= 0 && mesh.TextureIndices[(3 * face) + 1] >= 0 && mesh.TextureIndices[(3 * face) + 2] >= 0;
}
