using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Rays;

/// <summary>
/// Finds where rays hit many placed shapes: the objects of a scene (<c>SceneRayCaster</c>), or the sub-fractals around a camera
/// (<c>DeepZoomRayCaster</c>). Immutable, as <see cref="RayCaster"/> is.
/// </summary>
/// <remarks>A ray finds its shape in O(log n) for n that lie apart, by a hierarchy over their boxes.</remarks>
public abstract class InstanceRayCaster : RayCaster
{
    /// <summary>Takes the hierarchy over the placed shapes.</summary>
    /// <param name="instances">Null where there are none.</param>
    /// <param name="maxCoordinate">
    /// The largest absolute coordinate whose rounding the boxes do not contain; 0 where they contain all of it.
    /// </param>
    private protected InstanceRayCaster(ObjectBvh? instances, double maxCoordinate)
    {
        Instances = instances;
        ShapeMagnitude = maxCoordinate;
    }

    /// <summary>The placed shapes; null where there are none.</summary>
    private protected ObjectBvh? Instances { get; }

    /// <inheritdoc/>
    private protected override double ShapeMagnitude { get; }

    /// <inheritdoc/>
    private protected override bool TrySearch(
        in LocalRay ray, ref RaySearch search, QueryContext context, ref RayInstance? found, ref int pathLength)
    {
        if (Instances is not null)
        {
            RayInstanceSearch.Run(Instances.Root, in ray, ref search, context, ref found, ref pathLength);
        }

        return found is not null;
    }
}
