using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Drawables;

namespace FractalEngine.Render.Preparation;

/// <summary>The faces of a model sorted into one batch for each material, in the order in which the materials first occur.</summary>
/// <param name="batches">One batch for each material that occurs; none is empty.</param>
/// <param name="faceOrder">Indices in the mesh by positions in drawing order; null where the order is that of the mesh.</param>
/// <param name="degenerateTriangleCount">Number of faces that are not drawn since they have no area.</param>
internal sealed class FaceBatches(ImmutableArray<DrawableBatch> batches, int[]? faceOrder, int degenerateTriangleCount)
{
    /// <summary>Number of faces that are drawn.</summary>
    public int FaceCount => Batches.Sum(static batch => batch.IndexCount) / 3;

    /// <summary>Number of faces that are not drawn since they have no area.</summary>
    public int DegenerateTriangleCount { get; } = degenerateTriangleCount;

    /// <summary>One batch for each material that occurs; none is empty.</summary>
    public ImmutableArray<DrawableBatch> Batches { get; } = batches;

    /// <summary>True where any face has a texture.</summary>
    public bool HasTextures => Batches.Any(static batch => batch.Material is { Texture: not null } or { Detail: not null });

    /// <summary>Returns the index in the mesh of the face at a position in drawing order.</summary>
    /// <param name="drawIndex">Position in drawing order, from 0.</param>
    public int FaceAt(int drawIndex) => faceOrder is null ? drawIndex : faceOrder[drawIndex];

    /// <summary>Creates one batch of all faces, without a material.</summary>
    public static FaceBatches SingleBatch(Mesh mesh) => new([new(0, mesh.VertexIndices.Length, null)], null, 0);

    /// <summary>Sorts the faces of a model by material. Faces of one material keep their order.</summary>
    /// <param name="model">Model with its mesh and materials.</param>
    /// <param name="textures">Cache that decodes the textures.</param>
    /// <param name="removeDegenerate">Whether faces without area are removed.</param>
    public static FaceBatches ByMaterial(Model model, TextureCache textures, bool removeDegenerate)
    {
        var mesh = model.Mesh;
        bool[] isDegenerate = removeDegenerate
            ? [.. Enumerable.Range(0, mesh.FaceCount).Select(face => IsDegenerate(mesh, face))]
            : new bool[mesh.FaceCount];
        var degenerateCount = isDegenerate.Count(static degenerate => degenerate);
        var hasMaterials = !model.Materials.IsEmpty && !mesh.Groups.IsEmpty;
        if (!hasMaterials && degenerateCount == 0)
        {
            return SingleBatch(mesh);
        }

        var (materials, materialOfFace) = hasMaterials ? AssignMaterials(model, textures, isDegenerate) : ([null], new int[mesh.FaceCount]);
        // A counting sort: the first position of each material, then the faces in order.
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

    /// <summary>Returns the materials that occur, and for each face with area the index of its own among them.</summary>
    private static (List<DrawableMaterial?> Materials, int[] MaterialOfFace) AssignMaterials(
        Model model, TextureCache textures, bool[] isDegenerate)
    {
        var mesh = model.Mesh;
        var materials = new List<DrawableMaterial?>();
        var materialIndices = new Dictionary<(string? Name, bool HasTexture), int>();
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

                // A face without texture coordinates is drawn without the texture.
                var hasTexture = fileMaterial is { IsTextured: true } && HasTextureCoordinates(mesh, face);
                if (!materialIndices.TryGetValue((fileMaterial?.Name, hasTexture), out var materialIndex))
                {
                    materialIndex = materials.Count;
                    materialIndices.Add((fileMaterial?.Name, hasTexture), materialIndex);
                    materials.Add(fileMaterial is null
                        ? null : textures.GetMaterial(hasTexture ? fileMaterial : fileMaterial.WithoutImages()));
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
