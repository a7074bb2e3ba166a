using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Colliders;

/// <summary>Makes the collider of a kind for a mesh or a fractal, where the kind fits it.</summary>
public static class ColliderFactory
{
    /// <summary>
    /// Maximum number of faces of a fractal that is expanded into one mesh for a collider of meshes. The mesh may have three times as many
    /// vertices.
    /// </summary>
    public const long MaxExpandedFaces = 20_000_000;

    /// <summary>True for kinds whose colliders serve objects with any matrix, see <see cref="Collider.FindClosestTransformed"/>.</summary>
    internal static bool SupportsTransformedQueries(ColliderKind kind) =>
        kind is ColliderKind.Exact or ColliderKind.Hierarchy or ColliderKind.Simple;

    /// <summary>Throws for a number that stands for no kind.</summary>
    internal static void ThrowIfUnknown(ColliderKind kind)
    {
        if (!Enum.IsDefined(kind))
        {
            throw new ArgumentOutOfRangeException(nameof(kind), kind, "expected one of the kinds of colliders");
        }
    }

    internal static Collider Create(Fractal fractal, ColliderKind kind)
    {
        ThrowIfUnknown(kind);
        return (kind, fractal.Description.Composition) switch
        {
            (ColliderKind.Exact, Composition.Affine) => new ExactFractalCollider(fractal),
            (ColliderKind.Fractal, Composition.Affine) => fractal.Description.Parts.IsEmpty
                ? new FractalCollider(fractal)
                : throw new ColliderMismatchException(
                    "the collider 'fractal' descends the levels of one recursion, and this fractal has sums or several recursives: "
                    + "expected exact, hierarchy, bounding-box or simple"),
            _ => CreateExpanded(fractal, AffineMap.Identity, kind),
        };
    }

    /// <summary>Builds the collider of the mesh that a fractal is under a map.</summary>
    internal static Collider CreateExpanded(Fractal fractal, AffineMap toWorld, ColliderKind kind)
    {
        if (kind == ColliderKind.Fractal)
        {
            throw new ColliderMismatchException(
                "the collider 'fractal' descends by affine maps, which componentwise composition has not: "
                + "expected exact, hierarchy, bounding-box or simple");
        }

        return Create(Expand(fractal, toWorld, out _), kind);
    }

    /// <summary>Expands a fractal into one mesh under a map, with the faces of one instance after those of another.</summary>
    /// <exception cref="FractalLimitException">It has more than <see cref="MaxExpandedFaces"/> faces.</exception>
    internal static Mesh Expand(Fractal fractal, AffineMap map, out AffineMap[] instances)
    {
        if (fractal.HasSeveralMeshes)
        {
            instances = [];
            return fractal.FaceCount > MaxExpandedFaces
                ? throw new FractalLimitException($"the fractal has more than the limit of {MaxExpandedFaces} faces that are expanded")
                : FractalGenerator.Flatten([.. fractal.ByMesh.Select(part => (part.BaseMesh, ExpandInstances(part, map)))]);
        }

        instances = [.. ExpandInstances(fractal, map)];
        return FractalGenerator.Flatten(fractal.BaseMesh, ImmutableCollectionsMarshal.AsImmutableArray(instances));
    }

    private static ImmutableArray<AffineMap> ExpandInstances(Fractal fractal, AffineMap map)
    {
        // A face uses at most three vertices, but the base mesh may have any number of unused ones, which are expanded too.
        var facesPerInstance = Math.Max(1, Math.Max(fractal.BaseMesh.FaceCount, fractal.BaseMesh.VertexCount / 3));
        return [.. FractalGenerator.Expand(fractal, MaxExpandedFaces / facesPerInstance).Select(instance => map * instance)];
    }

    internal static Collider Create(Mesh mesh, ColliderKind kind) => kind switch
    {
        ColliderKind.Exact or ColliderKind.Hierarchy => new HierarchyCollider(mesh, TriangleBvh.For(mesh)),
        ColliderKind.BoundingBox => new BoundingBoxCollider(mesh),
        ColliderKind.Simple => new SimpleCollider(mesh),
        not ColliderKind.Fractal => throw new ArgumentOutOfRangeException(
            nameof(kind), kind, "expected one of the kinds of colliders"),
        _ => throw new ColliderMismatchException(
            "the collider 'fractal' needs a fractal, and this is a mesh: expected exact, hierarchy, bounding-box or simple"),
    };
}
