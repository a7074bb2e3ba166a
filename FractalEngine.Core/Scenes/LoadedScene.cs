using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes;

/// <summary>A scene whose objects all have their models, with what follows from both.</summary>
/// <param name="Scene">What the scene file, or the code, says.</param>
/// <param name="Objects">In the order of <see cref="Scene.Objects"/>.</param>
public sealed record LoadedScene(Scene Scene, ImmutableArray<PlacedModel> Objects)
{
    /// <summary>A box that holds all objects in world space.</summary>
    public BoundingBox Bounds { get; } =
        Objects.Aggregate(BoundingBox.Empty, (box, placed) => BoundingBox.Union(box, placed.Bounds));

    /// <summary>The models, each once, in the order of their first use.</summary>
    public IEnumerable<Model> Models => Objects.Select(placed => placed.Model).Distinct();

    /// <summary>
    /// The same scene with each object by the parts of its model, one after the other, see <see cref="Model.Parts"/>; the same object where
    /// each is its only part.
    /// </summary>
    public LoadedScene ByParts() => Models.All(static model => model.Parts.Length == 1)
        ? this
        : new(Scene, [.. Objects.SelectMany(static placed => placed.Parts)]);

    /// <summary>The models of the objects that no physics moves, each once.</summary>
    public IEnumerable<Model> StaticModels =>
        Objects.Where(static placed => placed.Declaration is not PhysicsObject).Select(static placed => placed.Model).Distinct();

    /// <summary>Adds up a number of the models of all objects, such as <see cref="Model.FaceCount"/>.</summary>
    /// <param name="count">Returns the number of a model; null where it is infinite.</param>
    /// <returns>Null where that of one object is infinite.</returns>
    public BigInteger? Sum(Func<Model, BigInteger?> count)
    {
        ArgumentNullException.ThrowIfNull(count);
        return Objects.Aggregate((BigInteger?)BigInteger.Zero, (sum, placed) => sum + count(placed.Model));
    }

    /// <summary>Places the models of a scene made in code, or loaded from a file.</summary>
    /// <exception cref="FractalEngineException">An object names a file that is not loaded.</exception>
    public static LoadedScene Of(Scene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        return new(scene, [.. scene.Objects.Select(declared => new PlacedModel(declared))]);
    }
}
