using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Finds the nearest face of a mesh through a tree of boxes: exact, with the same distances as <see cref="SimpleCollider"/> bit for bit,
/// and hundreds of times faster on large meshes.
/// </summary>
/// <param name="mesh">Its tree is built here: O(n·log n), on all cores, and the same on any number of them.</param>
public sealed class HierarchyCollider(Mesh mesh) : Collider
{
    private readonly FaceHierarchy _hierarchy = new(mesh);

    /// <inheritdoc/>
    public override bool IsExact => true;

    /// <inheritdoc/>
    public override long StorageBytes => _hierarchy.StorageBytes;

    /// <inheritdoc/>
    private protected override bool Find(Vector position, double within, double epsilon, QueryRecord record, out ClosestPoint closest)
    {
        record.ClearPath();
        // The search excludes its limit, and squaring rounds: begin a little above, and compare the distance itself in the end.
        var nearestSquared = (within * within * (1 + 1e-15)) + double.Epsilon;
        var (nearestFace, boundFactor, faceTests, boundTests) = (-1, (1 + epsilon) * (1 + epsilon), 0L, 0L);
        _hierarchy.Search(position, ref nearestSquared, ref nearestFace, boundFactor, ref faceTests, ref boundTests);
        record.FaceTests += faceTests;
        record.BoundTests += boundTests;
        if (nearestFace < 0)
        {
            closest = default;
            return false;
        }

        var (a, b, c) = mesh.Face(nearestFace);
        closest = FaceAnswer.Of(mesh, nearestFace, FaceKernel.ClosestPoint(position, a, b, c));
        return closest.Distance <= within;
    }
}
