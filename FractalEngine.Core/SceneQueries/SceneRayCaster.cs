using System.Collections.Immutable;
using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.SceneQueries;

/// <summary>
/// Finds where rays hit the objects of a scene, in world space. The caster of a model is made when the first ray may hit it, once for all
/// objects that show the model.
/// </summary>
public sealed class SceneRayCaster : InstanceRayCaster
{
    private readonly Dictionary<Model, Lazy<ShapeRayCaster>> _casters;
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
        : this(
            (scene ?? throw new ArgumentNullException(nameof(scene))).Objects,
            scene.Models.ToDictionary(model => model, CasterOf), scene.Bounds)
    {
    }

    private SceneRayCaster(
        ImmutableArray<PlacedModel> objects, Dictionary<Model, Lazy<ShapeRayCaster>> casters, BoundingBox bounds)
        : this(
            objects.IsEmpty ? null : ObjectBvh.Build([.. objects.Select((placed, index) => CreateInstance(casters, index, placed))]),
            casters, bounds)
    {
    }

    private SceneRayCaster(ObjectBvh? objects, Dictionary<Model, Lazy<ShapeRayCaster>> casters, BoundingBox bounds)
        : base(objects, bounds.MaxAbsCoordinate())
    {
        _casters = casters;
        _bounds = bounds;
    }

    /// <inheritdoc/>
    /// <remarks>Counts the casters that rays have needed so far, each once.</remarks>
    public override long StorageBytes =>
        _casters.Values.Where(static caster => caster.IsValueCreated).Sum(static caster => caster.Value.StorageBytes);

    /// <summary>Makes the caster of the same scene with one of its objects elsewhere, in O(log n) for n objects.</summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="placed">A model of the scene under another matrix.</param>
    /// <exception cref="ArgumentOutOfRangeException">The scene has no such object.</exception>
    /// <exception cref="ArgumentException">No object of the scene shows the model.</exception>
    /// <exception cref="SingularMatrixException">The matrix has no inverse.</exception>
    public SceneRayCaster WithObject(int index, PlacedModel placed)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(index);
        ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(index, Instances?.Count ?? 0);
        ArgumentNullException.ThrowIfNull(placed);
        ArgumentCheck.Require(_casters.ContainsKey(placed.Model), "expected the model of an object of the scene", nameof(placed));
        var objects = Instances!.With(CreateInstance(_casters, index, placed));
        if (objects.IsDegraded)
        {
            var leaves = new RayInstance[objects.Count];
            objects.CopyTo<RayInstance>(leaves);
            objects = ObjectBvh.Build(leaves);
        }

        return new(objects, _casters, BoundingBox.Union(_bounds, placed.Bounds));
    }

    /// <summary>
    /// Makes the caster of another scene, or of the same one with its objects elsewhere. The casters of models that both show are shared.
    /// </summary>
    /// <param name="scene">With its models loaded.</param>
    /// <exception cref="SingularMatrixException">The matrix of an object has no inverse.</exception>
    /// <remarks>Cost: O(n log n) for n objects. No model is prepared yet that was not before.</remarks>
    public SceneRayCaster WithScene(LoadedScene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        return new(
            scene.Objects,
            scene.Models.ToDictionary(
                model => model, model => _casters.GetValueOrDefault(model) ?? CasterOf(model)),
            scene.Bounds);
    }

    private static Lazy<ShapeRayCaster> CasterOf(Model model) => new(() => (ShapeRayCaster)model.CreateRayCaster());

    private static RayInstance CreateInstance(Dictionary<Model, Lazy<ShapeRayCaster>> casters, int index, PlacedModel placed) =>
        new(index, casters[placed.Model], placed.ObjectToWorld, placed.Bounds, placed.Model.Parts.Any(static part =>
            part.Materials.Values.Any(static material => material.Emission != Colour.Black)));
}
