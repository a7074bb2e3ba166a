using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Rays;

/// <summary>Casts rays at one mesh or fractal in its own frame, where <see cref="InstanceRayCaster"/> can place it.</summary>
internal abstract class ShapeRayCaster : RayCaster
{
    /// <summary>The mesh of the face that a search has hit.</summary>
    internal abstract Mesh MeshOf(in RaySearch search);

    /// <summary>Searches the nearest face of one shape along a ray, or any face where the search stops at the first.</summary>
    /// <param name="ray">In the shape's frame.</param>
    /// <param name="search">Receives the hit and the cost.</param>
    /// <param name="context">Receives the path to the instance of a hit in its buffer of the best path.</param>
    /// <param name="pathLength">Length of that path; unchanged where there is no nearer hit.</param>
    /// <returns>True when there is a nearer hit than before.</returns>
    internal abstract bool TryIntersect(in LocalRay ray, ref RaySearch search, QueryContext context, ref int pathLength);

    /// <summary>Finds the map of the instance that a search has hit, and records its path.</summary>
    /// <param name="search">The search with its hit.</param>
    /// <param name="pathLength">Length of the path of the search.</param>
    /// <param name="map">From the shape's frame to that of the result.</param>
    /// <param name="context">Has the path, and receives the instance.</param>
    internal abstract SimdAffineMap ResolveInstance(
        in RaySearch search, int pathLength, in AffineMap map, QueryContext context);

    /// <inheritdoc/>
    private protected sealed override bool TrySearch(
        in LocalRay ray, ref RaySearch search, QueryContext context, ref RayInstance? found, ref int pathLength) =>
        TryIntersect(in ray, ref search, context, ref pathLength);
}
