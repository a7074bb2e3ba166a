using System.Collections.Immutable;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility;

namespace FractalEngine.Core.Rays;

/// <summary>
/// Finds where rays hit a fractal around a camera that is so deep in it that coordinates are relative to a sub-fractal, see
/// <see cref="FractalAddress"/>. Immutable, as <see cref="RayCaster"/> is.
/// </summary>
/// <remarks>
/// Rays are cast at the sub-fractals around the camera, from the one that it is in to those so large that nothing beyond them is seen.
/// So no ray climbs the levels above, however many there are. Each sub-fractal has the precision of its own size.
/// </remarks>
public sealed class DeepZoomRayCaster
{
    // The rounding of a box and of its distance along a ray, as a part of the largest coordinate.
    private const double BoxError = 1e-14;

    private readonly Fractal _fractal;
    private readonly FractalHierarchy _hierarchy;
    private readonly ObjectBvh? _instances;

    /// <summary>Prepares the sub-fractals around a camera.</summary>
    /// <param name="fractal">In affine composition.</param>
    /// <param name="roots">See <see cref="FractalAddress.CollectRoots"/>; the nearest first.</param>
    /// <exception cref="ArgumentException">The fractal is composed componentwise.</exception>
    /// <exception cref="FractalLimitException">The bounds of some level overflow a double or don't converge.</exception>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    /// <remarks>Cost: milliseconds.</remarks>
    public DeepZoomRayCaster(Fractal fractal, ImmutableArray<LodRoot> roots)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        if (fractal.Description.Composition != Composition.Affine)
        {
            throw new ArgumentException("expected a fractal in affine composition", nameof(fractal));
        }

        _fractal = fractal;
        Roots = roots;
        // Cameras come to levels that searches from the whole fractal skip.
        _hierarchy = FractalHierarchy.Build(fractal, doublesPowers: false, keepsAllLevels: true);
        var whole = new FractalRayCaster(fractal, _hierarchy);
        var casters = new Dictionary<long, FractalRayCaster>();
        var instances = new List<RayInstance>();
        for (var i = 0; i < Roots.Length; i++)
        {
            var root = Roots[i];
            if (!casters.TryGetValue(root.RemainingLevels, out var caster))
            {
                caster = whole.At(root.RemainingLevels);
                casters.Add(root.RemainingLevels, caster);
            }

            if (!caster.Box.IsEmpty)
            {
                instances.Add(new(i, new(caster), root.FrameToCamera, Widened(caster.Box.Transform(root.FrameToCamera))));
            }
        }

        _instances = instances.Count == 0 ? null : ObjectBvh.Build(instances.ToArray());
    }

    /// <summary>The sub-fractals that rays are cast at.</summary>
    public ImmutableArray<LodRoot> Roots { get; }

    /// <summary>Finds the nearest face that a ray hits.</summary>
    /// <param name="ray">In world axes about the camera, in the unit of the sub-fractals' maps.</param>
    /// <param name="context">Receives the costs and the instance below the sub-fractal; one for each thread.</param>
    /// <param name="hit">The hit in the frame of the ray, if there is one.</param>
    /// <param name="rootIndex">Index in <see cref="Roots"/> of the sub-fractal; −1 for none.</param>
    /// <param name="minDistance">Smallest distance that counts, not negative.</param>
    /// <param name="maxDistance">Largest distance that counts; may be infinite.</param>
    /// <param name="footprint">How wide the ray is; a line unless stated.</param>
    /// <returns>False when the ray hits no face between the two distances.</returns>
    /// <exception cref="ArgumentException">The ray is not finite, its direction is 0, or a distance is negative or NaN.</exception>
    public bool TryFindNearest(
        Ray ray, QueryContext context, out RayHit hit, out int rootIndex, double minDistance = 0,
        double maxDistance = double.PositiveInfinity, RayFootprint footprint = default)
    {
        ArgumentNullException.ThrowIfNull(context);
        var direction = RayCaster.CheckedUnitDirection(in ray, minDistance, maxDistance);
        var search = Search(
            ray.Origin, direction, minDistance, maxDistance, stopsAtFirst: false, footprint, context, out var found, out var pathLength);
        rootIndex = found?.Index ?? -1;
        hit = found is null ? default : RayHitFactory.Create(
            ray.Origin, direction, in search, minDistance, maxDistance, _fractal.BaseMesh,
            found.Caster.Value.ResolveInstance(in search, pathLength, in found.ObjectToWorld, context));
        return found is not null;
    }

    /// <summary>Tells whether a ray hits any face, which is found sooner than the nearest.</summary>
    /// <param name="ray">In world axes about the camera, in the unit of the sub-fractals' maps.</param>
    /// <param name="context">Receives the costs; one for each thread.</param>
    /// <param name="minDistance">Smallest distance that counts, not negative.</param>
    /// <param name="maxDistance">Largest distance that counts; may be infinite.</param>
    /// <param name="footprint">How wide the ray is; a line unless stated.</param>
    /// <exception cref="ArgumentException">The ray is not finite, its direction is 0, or a distance is negative or NaN.</exception>
    public bool HitsAny(
        Ray ray, QueryContext context, double minDistance = 0, double maxDistance = double.PositiveInfinity,
        RayFootprint footprint = default)
    {
        ArgumentNullException.ThrowIfNull(context);
        var direction = RayCaster.CheckedUnitDirection(in ray, minDistance, maxDistance);
        Search(ray.Origin, direction, minDistance, maxDistance, stopsAtFirst: true, footprint, context, out var found, out _);
        return found is not null;
    }

    /// <summary>Computes the place of the instance that was hit last between the two colours of a gradient, from 0 to 1.</summary>
    /// <param name="gradient">Kind of the gradient; not <see cref="GradientKind.None"/>.</param>
    /// <param name="rootIndex">Index of the sub-fractal that was hit.</param>
    /// <param name="context">That of the query.</param>
    public float GradientFactorOf(GradientKind gradient, int rootIndex, QueryContext context)
    {
        ArgumentNullException.ThrowIfNull(context);
        var (levels, _, path) = Roots[rootIndex];
        foreach (var index in context.InstancePath)
        {
            var set = _hierarchy.MapSetAt(levels--)!;
            path = path.Append(index == set.IdentityIndex ? -1 : index, index, set.Maps.Length);
        }

        return path.ComputeGradientFactor(gradient, _fractal.LevelCount ?? long.MaxValue);
    }

    private static BoundingBox Widened(BoundingBox box)
    {
        var margin = BoxError * BoundingVolume.MaxAbsCoordinate(box) * Vector.One;
        return new(box.Minimum - margin, box.Maximum + margin);
    }

    private RaySearch Search(
        Vector origin, Vector unitDirection, double minDistance, double maxDistance, bool stopsAtFirst, RayFootprint footprint,
        QueryContext context, out RayInstance? found, out int pathLength)
    {
        context.ClearPath();
        (found, pathLength) = (null, 0);
        var search = new RaySearch(
            minDistance, maxDistance, stopsAtFirst, RayCaster.RoundingError(origin, minDistance, 0), footprint);
        if (_instances is not null)
        {
            var ray = LocalRay.Of(origin, unitDirection, minDistance);
            RayInstanceSearch.Run(_instances.Root, in ray, ref search, context, ref found, ref pathLength);
        }

        search.AddTo(context.Statistics);
        return search;
    }
}
