using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Rays;

/// <summary>
/// The planes of a convex solid around the base mesh, in double precision: rays that start on a face and leave it are told apart from those
/// that hit it.
/// </summary>
/// <remarks>In the units of the bounds of the base mesh, see <see cref="RayBounds"/>.</remarks>
internal sealed class RayPlanes
{
    private const int LaneCount = 4;

    // The normal, then the offset.
    private const int RowCount = 4;

    // The triangles of a mesh whose hull has more are tested as soon.
    private const int MaxPlanes = 16;

    private readonly Vector256<double>[] _rows = [];

    /// <summary>Prepares the hull of a mesh.</summary>
    public RayPlanes(Mesh mesh)
    {
        var volume = BoundingVolume.FromMesh(mesh);
        if (volume.Hull is not { } hull || hull.Planes.Length > MaxPlanes)
        {
            return;
        }

        var box = new RayBox(volume.Box);
        var rounding = RoundingErrors.Chain * (1 + (volume.Box.MaxAbsCoordinate() * box.InverseHalfExtent));
        var groups = (hull.Planes.Length + LaneCount - 1) / LaneCount;
        _rows = new Vector256<double>[groups * RowCount];
        for (var i = 0; i < groups * LaneCount; i++)
        {
            // The last plane fills the lanes that are left over.
            var (normal, offset, _) = hull.Planes[Math.Min(i, hull.Planes.Length - 1)];
            var height = (offset + volume.Margin - Vector.Dot(normal, volume.Box.Centre)) * box.InverseHalfExtent;
            ReadOnlySpan<double> values = [normal.X, normal.Y, normal.Z, height + rounding];
            for (var row = 0; row < RowCount; row++)
            {
                ref var lanes = ref _rows[(i / LaneCount * RowCount) + row];
                lanes = lanes.WithElement(i % LaneCount, values[row]);
            }
        }
    }

    /// <summary>True where there are none.</summary>
    public bool IsEmpty => _rows.Length == 0;

    /// <summary>Number of bytes of the planes.</summary>
    public long StorageBytes => 32L * _rows.Length;

    /// <summary>Tells whether a ray may hit the solid between the distances of a search.</summary>
    /// <param name="ray">The ray in the units of the base mesh.</param>
    /// <param name="search">The distances, and the rounding.</param>
    public bool MayHit(in RayFrame ray, in RaySearch search)
    {
        var (ox, oy, oz) = (Vector256.Create(ray.Origin[0]), Vector256.Create(ray.Origin[1]), Vector256.Create(ray.Origin[2]));
        var (dx, dy, dz) = (Vector256.Create(ray.Direction[0]), Vector256.Create(ray.Direction[1]), Vector256.Create(ray.Direction[2]));
        var widening = Vector256.Create(2 * ray.InverseScale * search.Error);
        var near = Vector256.Create((search.MinDistance - ray.Start) * ray.PerDistance) - widening;
        var far = Vector256.Create((search.MaxDistance - ray.Start) * ray.PerDistance) + widening;
        for (var i = 0; i < _rows.Length; i += RowCount)
        {
            var (nx, ny, nz) = (_rows[i], _rows[i + 1], _rows[i + 2]);
            var height = _rows[i + 3] + widening - ((nx * ox) + (ny * oy) + (nz * oz));
            // A ray in a plane is infinitely far on one side of its crossing; a slope of −0 would say the other side.
            var slope = (nx * dx) + (ny * dy) + (nz * dz) + Vector256<double>.Zero;
            var crossing = height / slope;
            var isEntry = Vector256.LessThan(slope, Vector256<double>.Zero);
            near = Vector256.MaxNative(near, Vector256.ConditionalSelect(isEntry, crossing, near));
            far = Vector256.MinNative(far, Vector256.ConditionalSelect(isEntry, far, crossing));
        }

        return VectorX4.HorizontalMax(near) <= -VectorX4.HorizontalMax(-far);
    }
}
