using System.Numerics;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Core.Rays;

/// <summary>
/// Finds where rays hit the objects of a scene, in world space. The caster of a model is made when the first ray may hit it, once for all
/// objects that show the model. Immutable, as <see cref="RayCaster"/> is.
/// </summary>
/// <remarks>A ray finds its object in O(log n) for n objects that lie apart, by a hierarchy over their boxes.</remarks>
public sealed class SceneRayCaster
{
    private readonly Dictionary<Model, Lazy<RayCaster>> _casters;
    private readonly ObjectBvh? _objects;
    private readonly BoundingBox _bounds;

    /// <summary>Prepares the objects of a scene made in code, or loaded from a file.</summary>
    /// <exception cref="FractalEngineException">An object names a file that is not loaded.</exception>
    /// <exception cref="SingularMatrixException">The matrix of an object has no inverse.</exception>
    public SceneRayCaster(Scene scene)
        : this(LoadedScene.Of(scene))
    {
    }

    /// <summary>Prepares the objects of a scene.</summary>
    /// <exception cref="SingularMatrixException">The matrix of an object has no inverse.</exception>
    /// <remarks>Cost: O(n log n) for n objects. No model is prepared yet.</remarks>
    public SceneRayCaster(LoadedScene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        _casters = scene.Models.ToDictionary(model => model, model => new Lazy<RayCaster>(() => RayCaster.For(model)));
        _objects = scene.Objects.IsEmpty
            ? null
            : ObjectBvh.Build([.. scene.Objects.Select((placed, index) => CreateInstance(index, placed))]);
        _bounds = scene.Bounds;
    }

    private SceneRayCaster(Dictionary<Model, Lazy<RayCaster>> casters, ObjectBvh objects, BoundingBox bounds)
    {
        _casters = casters;
        _objects = objects;
        _bounds = bounds;
    }

    /// <summary>Makes the caster of the same scene with one of its objects elsewhere, in O(log n) for n objects.</summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="placed">A model of the scene under another matrix.</param>
    /// <exception cref="ArgumentOutOfRangeException">The scene has no such object.</exception>
    /// <exception cref="ArgumentException">No object of the scene shows the model.</exception>
    /// <exception cref="SingularMatrixException">The matrix has no inverse.</exception>
    public SceneRayCaster WithObject(int index, PlacedModel placed)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(index);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(index, _objects?.Count ?? 0);
        ArgumentNullException.ThrowIfNull(placed);
        if (!_casters.ContainsKey(placed.Model))
        {
            throw new ArgumentException("expected the model of an object of the scene", nameof(placed));
        }

        var objects = _objects!.With(CreateInstance(index, placed));
        if (objects.IsDegraded)
        {
            var leaves = new RayInstance[objects.Count];
            objects.CopyTo<RayInstance>(leaves);
            objects = ObjectBvh.Build(leaves);
        }

        return new(_casters, objects, BoundingBox.Union(_bounds, placed.Bounds));
    }

    /// <summary>Finds the nearest face that a ray hits.</summary>
    /// <param name="ray">In world space.</param>
    /// <param name="context">Receives the costs and the instance; one for each thread.</param>
    /// <param name="hit">The hit in world space, if there is one.</param>
    /// <param name="objectIndex">Index of the object in the scene; −1 for none.</param>
    /// <param name="minDistance">Smallest distance that counts, scene units, not negative.</param>
    /// <param name="maxDistance">Largest distance that counts, scene units; may be infinite.</param>
    /// <param name="footprint">How wide the ray is; a line unless stated.</param>
    /// <returns>False when the ray hits no face between the two distances.</returns>
    /// <exception cref="ArgumentException">The ray is not finite, its direction is 0, or a distance is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">A model can't be prepared, see <see cref="RayCaster.For(Model)"/>.</exception>
    public bool TryFindNearest(
        Ray ray, QueryContext context, out RayHit hit, out int objectIndex, double minDistance = 0,
        double maxDistance = double.PositiveInfinity, RayFootprint footprint = default)
    {
        ArgumentNullException.ThrowIfNull(context);
        var direction = RayCaster.CheckedUnitDirection(in ray, minDistance, maxDistance);
        var search = Search(
            ray.Origin, direction, minDistance, maxDistance, stopsAtFirst: false, footprint, context, out var found, out var pathLength);
        objectIndex = found?.Index ?? -1;
        hit = found is null ? default : RayHitFactory.Create(
            ray.Origin, direction, in search, minDistance, maxDistance,
            found.Caster.Value.Mesh, found.Caster.Value.ResolveInstance(in search, pathLength, in found.ObjectToWorld, context));
        return found is not null;
    }

    /// <summary>Tells whether a ray hits any face, which is found sooner than the nearest.</summary>
    /// <param name="ray">In world space.</param>
    /// <param name="context">Receives the costs; one for each thread.</param>
    /// <param name="minDistance">Smallest distance that counts, scene units, not negative.</param>
    /// <param name="maxDistance">Largest distance that counts, scene units; may be infinite.</param>
    /// <param name="footprint">How wide the ray is; a line unless stated.</param>
    /// <exception cref="ArgumentException">The ray is not finite, its direction is 0, or a distance is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">A model can't be prepared, see <see cref="RayCaster.For(Model)"/>.</exception>
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
        var error = RayCaster.RoundingError(origin, minDistance, BoundingVolume.MaxAbsCoordinate(_bounds));
        var search = new RaySearch(minDistance, maxDistance, stopsAtFirst, error)
        {
            Footprint = footprint,
        };
        if (_objects is not null)
        {
            var ray = LocalRay.Of(origin, unitDirection, minDistance);
            SearchObjects(_objects.Root, in ray, ref search, context, ref found, ref pathLength);
        }

        search.AddTo(context.Statistics);
        return search;
    }

    /// <summary>Searches the objects in the order in which the ray enters their boxes.</summary>
    private static void SearchObjects(
        ObjectBvhNode root, in LocalRay ray, ref RaySearch search, QueryContext context, ref RayInstance? found, ref int pathLength)
    {
        var queue = context.ObjectQueue;
        queue.Clear();
        queue.Add(ray.Start, ObjectQueue.Untested, root);
        while (queue.TryTake(out var entry, out _, out var target) && entry <= search.MaxDistance)
        {
            if (target is ObjectBvhNode node)
            {
                search.BoundTests += node.ChildCount;
                var entries = node.RayEntries(in ray, in search);
                var isHit = Vector256.LessThanOrEqual(entries, Vector256.Create(search.MaxDistance));
                for (var slots = isHit.ExtractMostSignificantBits(); slots != 0; slots &= slots - 1)
                {
                    var slot = BitOperations.TrailingZeroCount(slots);
                    if (slot < node.ChildCount)
                    {
                        queue.Add(entries[slot], node[slot] is RayInstance leaf ? leaf.Index : ObjectQueue.Untested, node[slot]);
                    }
                }

                continue;
            }

            var instance = (RayInstance)target!;
            var local = instance.ToObject(in ray);
            if (instance.Caster.Value.TryIntersect(in local, ref search, context, ref pathLength))
            {
                found = instance;
                if (search.StopsAtFirst)
                {
                    break;
                }
            }
        }

        queue.Clear();
    }

    private RayInstance CreateInstance(int index, PlacedModel placed) =>
        new(index, _casters[placed.Model], placed.ObjectToWorld, placed.Bounds);
}
