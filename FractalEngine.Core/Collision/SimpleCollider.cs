using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>Looks at every face (paper §4.4.2): exact, and the reference that the others are compared with.</summary>
public sealed class SimpleCollider(Mesh mesh) : Collider
{
    /// <inheritdoc/>
    public override bool IsExact => true;

    /// <inheritdoc/>
    public override long StorageBytes => 0;

    /// <inheritdoc/>
    internal override bool FindsImages => true;

    /// <inheritdoc/>
    internal override bool FindImage(Vector position, AffineMap map, double within, double epsilon, QueryRecord record, out ClosestPoint closest)
    {
        record.ClearPath();
        record.FaceTests += mesh.FaceCount;
        var (nearest, nearestFace) = (double.PositiveInfinity, -1);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var squared = FaceKernel.ClosestPoint(position, map * a, map * b, map * c).DistanceSquared;
            (nearest, nearestFace) = squared < nearest ? (squared, face) : (nearest, nearestFace);
        }

        closest = nearestFace < 0 ? default : FaceAnswer.Of(mesh, nearestFace, map, position);
        return nearestFace >= 0 && closest.Distance <= within;
    }

    /// <inheritdoc/>
    private protected override bool Find(Vector position, double within, double epsilon, QueryRecord record, out ClosestPoint closest)
    {
        record.ClearPath();
        record.FaceTests += mesh.FaceCount;
        var (nearest, nearestFace) = (default(FacePoint), -1);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var point = FaceKernel.ClosestPoint(position, a, b, c);
            if (nearestFace < 0 || point.DistanceSquared < nearest.DistanceSquared)
            {
                (nearest, nearestFace) = (point, face);
            }
        }

        closest = nearestFace < 0 ? default : FaceAnswer.Of(mesh, nearestFace, nearest);
        return nearestFace >= 0 && closest.Distance <= within;
    }
}
