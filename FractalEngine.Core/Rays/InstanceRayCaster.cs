using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Rays;

/// <summary>
/// Finds where rays hit many placed shapes: the objects of a scene (<c>SceneRayCaster</c>), or the sub-fractals around a camera
/// (<c>DeepZoomRayCaster</c>). Immutable, as <see cref="RayCaster"/> is.
/// </summary>
/// <remarks>A ray finds its shape in O(log n) for n that lie apart, by a hierarchy over their boxes.</remarks>
public abstract class InstanceRayCaster
{
    private readonly double _maxCoordinate;

    /// <summary>Takes the hierarchy over the placed shapes.</summary>
    /// <param name="instances">Null where there are none.</param>
    /// <param name="maxCoordinate">
    /// The largest absolute coordinate whose rounding the boxes do not contain; 0 where they contain all of it.
    /// </param>
    private protected InstanceRayCaster(ObjectBvh? instances, double maxCoordinate)
    {
        Instances = instances;
        _maxCoordinate = maxCoordinate;
    }

    /// <summary>The placed shapes; null where there are none.</summary>
    private protected ObjectBvh? Instances { get; }

    /// <summary>Finds the nearest face that a ray hits.</summary>
    /// <param name="ray">In the frame of the instances.</param>
    /// <param name="context">Receives the costs and the instance; one for each thread.</param>
    /// <param name="hit">The hit in the frame of the ray, if there is one.</param>
    /// <param name="index">Index of the instance: of the object in its scene, or of the sub-fractal; −1 for none.</param>
    /// <param name="minDistance">Smallest distance that counts, scene units, not negative.</param>
    /// <param name="maxDistance">Largest distance that counts, scene units; may be infinite.</param>
    /// <param name="footprint">How wide the ray is; a line unless stated.</param>
    /// <returns>False when the ray hits no face between the two distances.</returns>
    /// <exception cref="ArgumentException">The ray is not finite, its direction is 0, or a distance is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">A model can't be prepared, see <see cref="RayCaster.For(Fractal)"/>.</exception>
    public bool TryFindNearest(
        Ray ray, QueryContext context, out RayHit hit, out int index, double minDistance = 0,
        double maxDistance = double.PositiveInfinity, RayFootprint footprint = default)
    {
        ArgumentNullException.ThrowIfNull(context);
        var direction = RayCaster.CheckedUnitDirection(in ray, minDistance, maxDistance);
        var search = Search(
            ray.Origin, direction, minDistance, maxDistance, stopsAtFirst: false, footprint, context, out var found, out var pathLength);
        index = found?.Index ?? -1;
        hit = found is null ? default : RayHitFactory.Create(
            ray.Origin, direction, in search, minDistance, maxDistance,
            found.Caster.Value.Mesh, found.Caster.Value.ResolveInstance(in search, pathLength, in found.ObjectToWorld, context));
        return found is not null;
    }

    /// <summary>Tells whether a ray hits any face, which is found sooner than the nearest.</summary>
    /// <param name="ray">In the frame of the instances.</param>
    /// <param name="context">Receives the costs; one for each thread.</param>
    /// <param name="minDistance">Smallest distance that counts, scene units, not negative.</param>
    /// <param name="maxDistance">Largest distance that counts, scene units; may be infinite.</param>
    /// <param name="footprint">How wide the ray is; a line unless stated.</param>
    /// <exception cref="ArgumentException">The ray is not finite, its direction is 0, or a distance is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">A model can't be prepared, see <see cref="RayCaster.For(Fractal)"/>.</exception>
    public bool HitsAny(
        Ray ray, QueryContext context, double minDistance = 0, double maxDistance = double.PositiveInfinity,
        RayFootprint footprint = default)
    {
        ArgumentNullException.ThrowIfNull(context);
        var direction = RayCaster.CheckedUnitDirection(in ray, minDistance, maxDistance);
        Search(ray.Origin, direction, minDistance, maxDistance, stopsAtFirst: true, footprint, context, out var found, out _);
        return found is not null;
    }

    private RaySearch Search(
        Vector origin, Vector unitDirection, double minDistance, double maxDistance, bool stopsAtFirst, RayFootprint footprint,
        QueryContext context, out RayInstance? found, out int pathLength)
    {
        context.ClearPath();
        found = null;
        pathLength = 0;
        var error = RayCaster.RoundingError(origin, minDistance, _maxCoordinate);
        var search = new RaySearch(minDistance, maxDistance, stopsAtFirst, error, footprint);
        if (Instances is not null)
        {
            var ray = LocalRay.Of(origin, unitDirection, minDistance);
            RayInstanceSearch.Run(Instances.Root, in ray, ref search, context, ref found, ref pathLength);
        }

        context.Statistics.Add(in search);
        return search;
    }
}
