using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Distances;

/// <summary>How far two surfaces are apart, in both directions, scene units.</summary>
/// <param name="Forward">How far the points of the first surface are from the second one.</param>
/// <param name="Backward">How far the points of the second surface are from the first one.</param>
/// <param name="Diagonal">The diagonal of the box around the first surface.</param>
public sealed record SurfaceDistance(OneSidedDistance Forward, OneSidedDistance Backward, double Diagonal)
{
    /// <summary>Bounds of the Hausdorff distance: the largest distance in either direction.</summary>
    public DistanceInterval MaxDistance => DistanceInterval.Max(Forward.MaxDistance, Backward.MaxDistance);

    /// <summary>The Chamfer distance: the mean of the mean distances in both directions.</summary>
    public double MeanDistance => 0.5 * (Forward.MeanDistance + Backward.MeanDistance);

    /// <summary>How far the mean distance may be off, see <see cref="OneSidedDistance.MeanDistanceError"/>.</summary>
    public double MeanDistanceError => 0.5 * (Forward.MeanDistanceError + Backward.MeanDistanceError);

    /// <summary>The mean of the mean angles between faces, radians, see <see cref="OneSidedDistance.MeanNormalAngle"/>.</summary>
    public double MeanNormalAngle => 0.5 * (Forward.MeanNormalAngle + Backward.MeanNormalAngle);

    /// <summary>Bounds of the Hausdorff distance as parts of the diagonal; infinite where the first surface is a single point.</summary>
    public DistanceInterval RelativeMaxDistance => new(PartOfDiagonal(MaxDistance.Lower), PartOfDiagonal(MaxDistance.Upper));

    /// <summary>The Chamfer distance as a part of the diagonal; infinite where the first surface is a single point.</summary>
    public double RelativeMeanDistance => PartOfDiagonal(MeanDistance);

    /// <summary>Measures how far two surfaces are apart.</summary>
    /// <param name="from">The first surface, with at least one face. Only faces count: the inside of a closed surface is empty.</param>
    /// <param name="to">The second surface, with at least one face.</param>
    /// <param name="settings">How exact, and what it may cost; null for the defaults.</param>
    /// <param name="cancellation">Ends the work within some milliseconds.</param>
    /// <exception cref="ArgumentException">A mesh has no faces.</exception>
    /// <exception cref="FractalLimitException">A distance is beyond the range of a double.</exception>
    /// <exception cref="OperationCanceledException">The work was cancelled.</exception>
    /// <remarks>
    /// Cost: a closest point for each vertex and each sample, and some µs for each piece that is divided. The result is the same on any
    /// number of threads. With the surfaces swapped, it has the same numbers in the other order.
    /// </remarks>
    public static SurfaceDistance Between(
        Mesh from, Mesh to, SurfaceDistanceSettings? settings = null, CancellationToken cancellation = default)
    {
        ThrowIfEmpty(from, nameof(from));
        ThrowIfEmpty(to, nameof(to));
        settings ??= new();
        var loop = new BlockLoop(settings.MaxThreads, cancellation);
        var diagonal = from.UsedBounds.Diagonal;
        var scale = QueryScale.Of(Math.Max(QueryScale.Magnitude(from), QueryScale.Magnitude(to)));
        if (scale != 1)
        {
            (from, to) = (Scale(from, scale), Scale(to, scale));
        }

        var magnitude = Math.Max(QueryScale.Magnitude(from), QueryScale.Magnitude(to));
        var resolution = settings.Resolution * Math.Max(from.UsedBounds.Diagonal, to.UsedBounds.Diagonal);
        var rounding = BoundCutoff.KernelError * magnitude;
        var forward = new OneSidedMeasurement(from, new(to), settings, loop).Run(resolution, rounding).DividedBy(scale);
        var backward = new OneSidedMeasurement(to, new(from), settings, loop).Run(resolution, rounding).DividedBy(scale);
        ScaledQuery.ThrowIfInfinite(Math.Max(forward.MaxDistance.Upper, backward.MaxDistance.Upper));
        return new(forward, backward, diagonal);
    }

    private static void ThrowIfEmpty(Mesh mesh, string name)
    {
        ArgumentNullException.ThrowIfNull(mesh, name);
        ArgumentCheck.Require(mesh.FaceCount > 0, "expected a mesh with at least one face", name);
    }

    private static Mesh Scale(Mesh mesh, double scale) =>
        new([.. mesh.Positions.Select(coordinate => scale * coordinate)], mesh.VertexIndices);

    // Never NaN, also of two surfaces at one point.
    private double PartOfDiagonal(double distance) => distance == 0 ? 0 : distance / Diagonal;
}
